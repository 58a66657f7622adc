// Boundaries of data/scenes/rotating_mass.toml compared with independently computed spectra.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "eigentrail/reduction/reduced_pencil.hpp"
#include "eigentrail/steady/equilibrium.hpp"
#include "stability/boundaries.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::boundary_rotating_mass_test {
namespace {

/// Largest real part of all eigenvalues, from an equilibrium and null space computed here and QZ on the
/// unscaled companion form.
double spectral_abscissa(const Model& model, double omega, double a_n) {
  const Parameters& list = model.description().parameters;
  Vector parameters = list.declared_values();
  parameters[*list.index("omega")] = omega;
  parameters[*list.index("a_n")] = a_n;
  EvaluationCounts counts = model.new_counts();
  const Equilibrium at =
      solve_equilibrium(model, parameters, model.initial_guess(parameters), {}, {}, counts);
  if (at.status != SteadyStatus::converged) throw std::runtime_error(at.report.message);
  const Linearization& lin = at.linearization;
  const Matrix T = at.kkt.constraints().null_basis();
  double largest = -INFINITY;
  for (const Complex s : quadratic_eigenvalues(T.transpose() * lin.M[0] * T, T.transpose() * lin.C[0] * T,
                                               T.transpose() * lin.K[0] * T))
    largest = std::max(largest, s.real());
  return largest;
}

/// omega and another parameter over the given ranges.
BoundarySetup prepare_blade(const std::string& second, Place low, Place high, double tolerance) {
  BoundaryRequest request;
  request.second = second;
  request.from = low[1];
  request.to = high[1];
  request.overrides = {
      {"from", exact_text(low[0])}, {"to", exact_text(high[0])}, {"tolerance", exact_text(tolerance)}};
  return prepare_boundary(read_scene(std::string(EIGENTRAIL_DATA_DIR) + "/scenes/rotating_mass.toml"),
                          request);
}

/// Below 10 rad/s the blade has several equilibria. Boundaries of different equilibria intersect in the
/// plane.
TEST(BoundaryRotatingMass, CurvesOfDifferentEquilibriaMakeNoCorners) {
  const BoundarySetup setup = prepare_blade("drag", {5.0, 0.5}, {16.0, 320.0}, 1e-8);
  const BoundaryResult result = find_boundaries(*setup.model, setup.options);
  EXPECT_EQ(result.status, BoundaryStatus::completed) << result.message;
  EXPECT_GE(result.curves.size(), 2U);
  EXPECT_TRUE(result.corners.empty());
  const auto told = [](const std::string& note) {
    return note.starts_with("intersections of curves that belong");
  };
  EXPECT_TRUE(std::any_of(result.notes.begin(), result.notes.end(), told));
}

/// Where the flutter of a trace of the blade lies.
double flutter_of_trace(const OptionTexts& options, const std::string& drag = "2.0") {
  const Setting setting =
      scene_setting("rotating_mass", options, {{"drag   = { value = 2.0", "drag   = { value = " + drag}});
  const TraceResult result = trace(*setting.model, setting.options, {});
  return only_event(result, EventKind::flutter).p;
}

// In 40 digits: tests/hard_cases/reference_multibody.py.
TEST(RotatingMassFlutter, InTheSpeed) {
  EXPECT_NEAR(flutter_of_trace({}) / 12.4393882230095183, 1.0, 1e-9);
  EXPECT_NEAR(flutter_of_trace({}, "20.0") / 8.41860515331042239, 1.0, 1e-9);
}

TEST(BoundaryRotatingMass, AgreesWithAnIndependentScan) {
  const BoundarySetup setup = prepare_blade("a_n", {5.0, 200.0}, {45.0, 20000.0}, 1e-10);
  const BoundaryResult result = find_boundaries(*setup.model, setup.options);
  const auto flutter = curves_of_kind(result, BoundaryKind::flutter);
  ASSERT_EQ(flutter.size(), 1U);
  int compared = 0;
  const std::size_t steps = flutter[0].steps.size();
  for (int i = 0; i < 50; ++i) {
    const double along = (i + 0.5) / 50.0 * static_cast<double>(steps);
    const auto step = static_cast<std::size_t>(along);
    const Eigen::Vector4d at = evaluate_step(flutter[0].steps[step], along - static_cast<double>(step));
    double low = at[0] * (1.0 - 1e-4);
    double high = at[0] * (1.0 + 1e-4);
    ASSERT_GT(spectral_abscissa(*setup.model, low, at[1]), 0.0) << "at a_n = " << at[1];
    ASSERT_LT(spectral_abscissa(*setup.model, high, at[1]), 0.0) << "at a_n = " << at[1];
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (spectral_abscissa(*setup.model, middle, at[1]) > 0.0 ? low : high) = middle;
    }
    EXPECT_NEAR(at[0] / low, 1.0, 1e-8) << "at a_n = " << at[1];
    ++compared;
  }
  EXPECT_EQ(compared, 50);
  // It goes through the points that traces along either parameter find.
  const double a_n = flutter_of_trace({{"parameter", "a_n"}, {"from", "1000"}, {"to", "20000"}});
  for (const auto& [omega, force] : {std::pair(12.4393882230095183, 1000.0), std::pair(40.0, a_n)}) {
    double nearest = INFINITY;
    largest_miss(flutter[0], 20000, [&, omega = omega, force = force](const auto& at) {
      nearest = std::min(nearest, std::hypot(at[0] / omega - 1.0, at[1] / force - 1.0));
      return 0.0;
    });
    EXPECT_LT(nearest, 1e-3);
  }
}

}  // namespace
}  // namespace eigentrail::test::boundary_rotating_mass_test
