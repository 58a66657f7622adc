// Newton's method with the natural monotonicity test, and what it is for: equilibria of slender beams.
#include "steady/error_oriented_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/steady/equilibrium.hpp"
#include "steady/heavy_elastica.hpp"
#include "steady/scalar_problem.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::error_oriented_newton_test {
namespace {

TEST(ErrorOrientedNewton, DampsWherePlainNewtonDiverges) {
  const NonlinearProblem problem = arctangent();
  Vector u{{20.0}};
  Vector whole_steps = u;
  EXPECT_FALSE(solve_error_oriented(problem, 1, {.least_damping = 1.0}, whole_steps).converged);
  EXPECT_TRUE(solve_error_oriented(problem, 1, {.tolerance = 1e-10, .max_iterations = 50}, u).converged);
  EXPECT_NEAR(u[0], 0.0, 1e-9);
}

TEST(ErrorOrientedNewton, GivesAReasonWhenThereIsNoRoot) {
  Vector u{{1.0}};
  const NonlinearResult result =
      solve_error_oriented(square_and_one(), 1, {.tolerance = 1e-10, .max_iterations = 50}, u);
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.message.empty());
}

/// Bent until it hangs; the load is added in steps where damped steps become short.
class SlenderBeams : public testing::TestWithParam<double> {};

TEST_P(SlenderBeams, FindTheirEquilibriumUnderTheirWeight) {
  const double weight = GetParam();
  const HeavyCantilever beam(weight, "elements = 40");
  const Equilibrium& found = beam.found;
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_FALSE(found.report.relaxed);
  EXPECT_LT(found.report.iterations, 200);
  const Vector tip = heavy_elastica(weight);
  EXPECT_NEAR(beam.tip()[0], tip[0], 1e-4);
  EXPECT_NEAR(beam.tip()[2], -std::abs(tip[1]), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Weights, SlenderBeams,
                         testing::Values(1.0, 1.5, 2.0, 2.4, 2.5, 2.51, 3.0, 10.0, 30.0));

}  // namespace
}  // namespace eigentrail::test::error_oriented_newton_test
