// Loads that are added in steps: equilibria far from the guess.
#include "steady/load_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/steady/equilibrium.hpp"
#include "steady/heavy_elastica.hpp"
#include "steady/scalar_problem.hpp"

namespace eigentrail::test::load_steps_test {
namespace {

TEST(LoadSteps, ArriveWhereWholeStepsOfNewtonsMethodDiverge) {
  const NonlinearProblem problem = arctangent();
  Vector u{{20.0}}, rival = u;
  EXPECT_FALSE(solve_by_whole_steps(problem, 1, 1e-8, 200, rival).converged);
  EXPECT_TRUE(solve_in_load_steps(problem, 1, u).converged);
  EXPECT_NEAR(u[0], 0.0, 1e-9);
}

TEST(LoadSteps, SayHowMuchOfTheLoadIsBorneWhereThereIsNoRoot) {
  // u^2 + 1 = 2 (1 - t) has solutions up to t = 1/2.
  Vector u{{1.0}};
  const NonlinearResult result = solve_in_load_steps(square_and_one(), 1, u);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.message.find("beyond 0.49"), std::string::npos) << result.message;
  EXPECT_LT(std::abs(u[0]), 0.1);
}

/// A beam of 100 elements, 1212 coordinates, that is straight in the guess, under weights per length of 1 to
/// 20 EI/L^3.
TEST(LoadSteps, FindALargeBeamThatBendsFarUnderItsWeight) {
  for (const double weight : {1.0, 5.0, 20.0}) {
    const HeavyCantilever beam(weight, "elements = 100\ndegree = 1");
    const Equilibrium& found = beam.found;
    ASSERT_EQ(found.status, SteadyStatus::converged) << weight << ": " << found.report.message;
    EXPECT_LT(found.report.factorizations, 200) << weight;
    const Vector tip = heavy_elastica(weight);
    EXPECT_NEAR(beam.tip()[0], tip[0], 1e-3) << weight;
    EXPECT_NEAR(beam.tip()[2], -std::abs(tip[1]), 1e-3) << weight;
  }
}

}  // namespace
}  // namespace eigentrail::test::load_steps_test
