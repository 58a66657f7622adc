// Large scenes of bodies, beams and joints against the whole scene, by solvers that know nothing of
// projections.
#include <gtest/gtest.h>

#include <random>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/projection/route.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "scene/input_error.hpp"
#include "support/large_families.hpp"
#include "support/large_scenes.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::large_scenes_test {
namespace {

Setting cantilever(const OptionTexts& overrides, const std::string& weight = "0") {
  return slender_cantilever(100, overrides, weight);
}

/// The whole scene at a place, [M 0; 0 0], [C 0; 0 0], [K A^T; A 0], with an equilibrium of its own.
AffinePencil<SparseMatrix> whole(const Setting& setting, double p) {
  const PathProblem problem = setting.problem();
  const Vector parameters = parameters_at(problem, p);
  EvaluationCounts counts = setting.model->new_counts();
  const Equilibrium at = solve_equilibrium(*setting.model, parameters,
                                           setting.model->initial_guess(parameters), Vector(), {}, counts);
  EXPECT_EQ(at.status, SteadyStatus::converged) << at.report.message;
  const Linearization& lin = at.linearization;
  const Eigen::Index n = setting.model->n_coordinates(), m = setting.model->n_constraints();
  const auto extended = [&](const SparseMatrix& B, bool constraints) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index j = 0; j < n; ++j) {
      for (SparseMatrix::InnerIterator e(B, j); e; ++e) entries.emplace_back(e.row(), j, e.value());
      if (!constraints) continue;
      for (SparseMatrix::InnerIterator e(lin.A[0].sparse(), j); e; ++e) {
        entries.emplace_back(n + e.row(), j, e.value());
        entries.emplace_back(j, n + e.row(), e.value());
      }
    }
    SparseMatrix result(n + m, n + m);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  };
  return {{{1.0, extended(lin.M[0].sparse(), false)}},
          {{1.0, extended(lin.C[0].sparse(), false)}},
          {{1.0, extended(lin.K[0].sparse(), true)}}};
}

struct Traced {
  Setting setting;  ///< with the projected model
  RecordedTrace record;

  const Projection& projection() const { return *setting.model->projection(); }
};

Traced project_and_trace(Setting setting) {
  Traced traced{std::move(setting), {}};
  EXPECT_TRUE(is_large(*traced.setting.model, traced.setting.options));
  project_if_large(traced.setting.model, traced.setting.options);
  traced.record = record_trace(traced.setting);
  EXPECT_EQ(traced.record.result.status, TraceStatus::completed) << traced.record.result.message;
  return traced;
}

/// Largest relative distance of the traced eigenvalues at random places from those of the whole scene.
double error(const Setting& scene, const Traced& traced, int places) {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> random(scene.options.from, scene.options.to);
  double largest = 0.0;
  for (int i = 0; i < places; ++i) {
    const double p = random(engine);
    const AffinePencil<SparseMatrix> pencil = whole(scene, p);
    for (const Complex s : traced.record.eigenvalues_at(p)) {
      const Complex exact = eigenvalues_near(pencil, s * Complex(1.0 + 1e-4, 1e-4), 1).front();
      largest = std::max(largest, std::abs(s - exact) / std::abs(s));
    }
  }
  return largest;
}

TEST(LargeScenes, ARotatingCantileverAgreesWithTheWholeScene) {
  const OptionTexts options{{"modes", "4"}, {"to", "6"}};
  const Traced traced = project_and_trace(cantilever(options));
  EXPECT_LT(error(cantilever(options), traced, 3), 1e-6);
  EXPECT_LE(traced.projection().factorizations, 12);
  EXPECT_LT(traced.record.result.n_independent, 100);
  EXPECT_EQ(traced.projection().freedoms, 600);
  // Flap of an Euler-Bernoulli cantilever; elements of second order, and a section of finite size.
  EXPECT_NEAR(traced.record.eigenvalues_of_node(0)[0].imag(), 3.5160152685, 1e-2);
}

TEST(LargeScenes, RedundantConstraintsAreRefusedInWords) {
  const std::string twice = "[[weld]]\nfrom = \"corner 05\"\nto = \"rail 05.tip\"\n";
  Setting setting = make_setting(ladder(6) + twice, {{"modes", "3"}});
  const std::string message =
      error_text<NotProjected>([&] { project_if_large(setting.model, setting.options); });
  EXPECT_TRUE(contains(message, "depend on others")) << message;
}

}  // namespace
}  // namespace eigentrail::test::large_scenes_test
