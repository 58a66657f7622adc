// Large scenes of bodies, beams and joints against the whole scene, by solvers that know nothing of
// projections.
#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/projection/large_spectrum.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "support/large_families.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

/// The cantilever of data/scenes/rotating_cantilever.toml with 100 elements of two nodes: 1212 coordinates.
Setting cantilever(const OptionTexts& overrides, const std::string& weight = "0") {
  return scene_setting("rotating_cantilever", overrides,
                       {{"elements     = 10", "elements = 100\ndegree = 1"},
                        {"slender = 1e-6", "slender = 1e-4\nweight = " + weight},
                        {"[[beam]] ", "[gravity]\nacceleration = [0, 0, \"-weight\"]\n[[beam]] "}});
}

/// Two rails along x, clamped in the rotating frame, with rungs along y between bodies at the ends of every
/// bay.
std::string ladder(int bays) {
  std::ostringstream text;
  text << "[parameters]\nomega = 0\n[trace]\nparameter = \"omega\"\nfrom = 0\nto = 2\n"
          "[frame]\nangular_velocity = [0, 0, \"omega\"]\n";
  const auto beam = [&](const std::string& name, const std::string& from, const std::string& to,
                        const std::string& y_axis) {
    text << "[[beam]]\nname = \"" << name << "\"\nfrom = " << from << "\nto = " << to
         << "\nelements = 4\ndegree = 1\ny_axis = " << y_axis
         << "\nmass = 1\nEA = 1e4\nEI_flap = 1\nEI_lag = 2\nGJ = 1\n";
  };
  for (int bay = 1; bay <= bays; ++bay) {
    std::string corner[2];
    for (const int rail : {0, 1}) {
      const std::string place = rail == 0 ? "-0.5" : "0.5";
      const std::string number = std::to_string(rail) + std::to_string(bay);
      corner[rail] = "\"corner " + number + "\"";
      text << "[[body]]\nname = " << corner[rail]
           << "\nmass = 0.01\ninertia = [1e-4, 1e-4, 1e-4]\nposition = [" << bay << ", " << place << ", 0]\n";
      const std::string before = bay == 1
                                     ? "[0, " + place + ", 0]"
                                     : "\"corner " + std::to_string(rail) + std::to_string(bay - 1) + "\"";
      beam("rail " + number, before, corner[rail], "[0, 1, 0]");
    }
    beam("rung " + std::to_string(bay), corner[0], corner[1], "[1, 0, 0]");
  }
  return text.str();
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
  EXPECT_TRUE(is_large_scene(*traced.setting.model, traced.setting.options));
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

TEST(LargeScenes, AreThoseOfAThousandCoordinatesWithSomeModes) {
  const auto is_large = [](int bays, const OptionTexts& options) {
    const Setting setting = make_setting(ladder(bays), options);
    return is_large_scene(*setting.model, setting.options);
  };
  EXPECT_FALSE(is_large(4, {{"modes", "3"}}));
  EXPECT_TRUE(is_large(5, {{"modes", "3"}}));
  EXPECT_FALSE(is_large(5, {}));  // all modes: with all freedoms
  EXPECT_THROW(is_large(26, {}), InputError);
}

TEST(LargeScenes, RedundantConstraintsAreRefusedInWords) {
  const std::string twice = "[[weld]]\nfrom = \"corner 05\"\nto = \"rail 05.tip\"\n";
  Setting setting = make_setting(ladder(6) + twice, {{"modes", "3"}});
  try {
    project_if_large(setting.model, setting.options);
    FAIL() << "was projected";
  } catch (const NotProjected& error) {
    EXPECT_NE(std::string(error.what()).find("depend on others"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace eigentrail::test
