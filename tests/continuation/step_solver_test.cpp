// The point at the end of a step: who is who there, or why there is none.
#include "continuation/step/step_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::step_solver_test {
namespace {

using Kind = Verdict::Kind;

/// Frequencies 2 + p and 2.6 - p in one block, and 5: the first two cross at p = 0.3.
Planted crossing() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}));
}

TEST(Attempt, NumbersTracksOnceAndHandsTheNumbersOn) {
  PlantedSearch planted(crossing());
  StepOrigin origin{planted.family.point(0.0, {{{2.6 * j, 2.0 * j}}, {{5.0 * j}}})};
  origin.lineages = 7;
  origin.node.tracks[0].lineage = 4;
  StepSolver solver(planted.solver, origin);
  for (const double h : {0.1, 0.2}) {
    const Step step = solver.attempt(h).step.value();
    EXPECT_EQ(step.right.tracks[0].lineage, 4U);
    EXPECT_EQ(step.right.tracks[1].lineage, 8U);
    EXPECT_EQ(origin.lineages, 8U);
  }
}

/// Steps of a pushed pendulum, whose equilibrium moves, from a point of its path.
struct StepsOfAPendulum : OnPath {
  explicit StepsOfAPendulum(double p) : OnPath(pushed_pendulum({}), p, With::modes), origin{node} {
    for (Track& track : origin.node.tracks) track.modes = track.arriving = {0};
  }
  StepOrigin origin;
  StepSolver solver{points, origin};
};

TEST(Attempt, SaysWhyThereIsNoPoint) {
  StepsOfAPendulum pendulum(0.9);
  EXPECT_TRUE(pendulum.solver.attempt(0.05).step);
  const AttemptedStep attempted = pendulum.solver.attempt(0.2);
  EXPECT_FALSE(attempted.step);
  EXPECT_EQ(attempted.verdict.kind, Kind::no_equilibrium);
  EXPECT_EQ(attempted.verdict.error, INFINITY);
  EXPECT_FALSE(attempted.verdict.reason.empty());
}

/// A pair that becomes real within the step has no complex eigenvalue to converge to.
TEST(Attempt, NamesTheTrackThatIsLost) {
  PlantedSearch planted(Planted({{Matrix::Identity(2, 2)},
                                 {Matrix{{0.1, 0.0}, {0.0, 1.0}}},
                                 {Matrix{{9.0025, 0.0}, {0.0, 1.0}}, Matrix{{0.0, 0.0}, {0.0, -1.0}}}}));
  const auto pair = [](double p) { return Complex(-0.5, std::sqrt(0.75 - p)); };
  planted.family.counts = {};
  StepOrigin origin{planted.family.point(0.7, alone({{-0.05, 3.0}, pair(0.7)}))};
  StepSolver solver(planted.solver, origin);
  EXPECT_TRUE(solver.attempt(0.02).step);
  const AttemptedStep attempted = solver.attempt(0.0499999);
  if (!attempted.step) {
    EXPECT_EQ(attempted.verdict.kind, Kind::mode_lost);
    EXPECT_EQ(attempted.verdict.track, 1);
  } else {
    // If the corrector converges nevertheless, it must be to the pair.
    EXPECT_LT(std::abs(attempted.step->right.tracks[1].roots[0] - pair(0.7499999)), 1e-6);
  }
}

}  // namespace
}  // namespace eigentrail::test::step_solver_test
