// The point at the end of a step: who is who there, what an earlier attempt saves, and which modes are
// accepted as they were extrapolated.
#include "continuation/step/step_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::step_solver_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double reach = 3.0;
using Kind = Verdict::Kind;

/// Frequencies 2 + p and 2.6 - p in one block, and 5: the first two cross at p = 0.3.
Planted crossing() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.6, -1.0}, {5.0, 0.0}}));
}

TEST(Attempt, KeepsTheOrderOfTheModesOfABlock) {
  PlantedSearch planted(crossing());
  StepOrigin origin{planted.family.point(0.0, {{{2.6 * j, 2.0 * j}}, {{5.0 * j}}})};
  StepSolver solver(planted.solver, origin, reach);
  const AttemptedStep attempted = solver.attempt(0.2);
  ASSERT_TRUE(attempted.step);
  EXPECT_TRUE(attempted.verdict.accepted());
  const Step& step = *attempted.step;
  EXPECT_EQ(step.left, &origin.node);
  EXPECT_EQ(step.h, 0.2);
  EXPECT_EQ(step.right.p, 0.2);
  const Track& block = step.right.tracks[0];
  EXPECT_EQ(block.modes, (std::vector<int>{0, 1}));
  EXPECT_EQ(block.arriving, block.modes);
  EXPECT_LT(distance(block.roots, ComplexVector{{2.4 * j, 2.2 * j}}), rounding);
  EXPECT_TRUE(block.told_apart);
}

TEST(Attempt, NumbersTracksOnceAndHandsTheNumbersOn) {
  PlantedSearch planted(crossing());
  StepOrigin origin{planted.family.point(0.0, {{{2.6 * j, 2.0 * j}}, {{5.0 * j}}})};
  origin.lineages = 7;
  origin.node.tracks[0].lineage = 4;
  StepSolver solver(planted.solver, origin, reach);
  for (const double h : {0.1, 0.2}) {
    const Step step = solver.attempt(h).step.value();
    EXPECT_EQ(step.right.tracks[0].lineage, 4U);
    EXPECT_EQ(step.right.tracks[1].lineage, 8U);
    EXPECT_EQ(origin.lineages, 8U);
  }
}

TEST(Attempt, ReusesWhatWasComputedAtTheSameDistanceOnly) {
  PlantedSearch planted(crossing());
  StepOrigin origin{planted.family.point(0.0, alone({2.0 * j, 2.6 * j, 5.0 * j}))};
  StepSolver solver(planted.solver, origin, reach);
  const Step first = solver.attempt(0.1).step.value();
  const auto factorizations = [&](double h) {
    const std::uint64_t before = planted.family.counts.modes.factorizations;
    const Step step = solver.attempt(h).step.value();
    EXPECT_LT(std::abs(step.right.tracks[2].roots[0] - 5.0 * j), rounding);
    return planted.family.counts.modes.factorizations - before;
  };
  const std::uint64_t all = factorizations(0.1);
  ASSERT_GT(all, 0U);
  origin.tried = TriedPoint{0.1, first.right.tracks};
  EXPECT_EQ(factorizations(0.1), 0U);
  EXPECT_EQ(factorizations(0.11), all);
  // A track that was joined meanwhile has another number.
  origin.tried->tracks[1].lineage = 99;
  EXPECT_EQ(3 * factorizations(0.1), all);
}

/// Steps of a pushed pendulum, whose equilibrium moves, from a point of its path.
struct StepsOfAPendulum : OnPath {
  explicit StepsOfAPendulum(double p) : OnPath(pushed_pendulum({}), p, With::modes), origin{node} {
    for (Track& track : origin.node.tracks) track.modes = track.arriving = {0};
  }
  StepOrigin origin;
  StepSolver solver{points, origin, reach};
};

/// Equilibrium, reduction and the series of the equations do not depend on the blocks.
TEST(Attempt, ComputesTheEquationsOnceForOneDistance) {
  StepsOfAPendulum pendulum(0.6);
  const Step first = pendulum.solver.attempt(0.05).step.value();
  const PathNode whole = first.right;
  pendulum.origin.tried = TriedPoint{0.05, {}, first.right};  // no track is known
  const auto linearizations = pendulum.counts.evaluations.linearization;
  const Step again = pendulum.solver.attempt(0.05).step.value();
  EXPECT_EQ(pendulum.counts.evaluations.linearization, linearizations);
  EXPECT_EQ(again.right.path.x, whole.path.x);
  EXPECT_EQ(again.right.pencil.K, whole.pencil.K);
  EXPECT_EQ(again.right.tracks[0].series.Lambda, whole.tracks[0].series.Lambda);
  EXPECT_FALSE(pendulum.origin.tried->equations) << "used once";
  const Step anew = pendulum.solver.attempt(0.05).step.value();
  EXPECT_NE(pendulum.counts.evaluations.linearization, linearizations);
  EXPECT_EQ(anew.right.tracks[0].series.Lambda, whole.tracks[0].series.Lambda);
}

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
  StepSolver solver(planted.solver, origin, reach);
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

/// Two damped modes s = a + jw with smooth coefficients, followed alone over two equal steps.
struct Smooth {
  explicit Smooth(double damping)
      : planted(Planted({{Matrix::Identity(2, 2)},
                         {Matrix{{2.0 * damping, 0.0}, {0.0, 2.0 * damping}}},
                         {Matrix{{4.0, 0.0}, {0.0, 25.0}}, Matrix{{0.2, 0.0}, {0.0, 0.3}}}},
                        3)),
        problem(planted.family.problem()),
        points(problem, planted.frame, planted.family.counts),
        d(damping) {
    problem.corrector.passing_error = 1e-8;
    origin.previous = at(0.0).tracks;
    origin.node = at(h);
    origin.last_step = h;
    for (std::size_t i = 0; i < 2; ++i) origin.previous[i].lineage = origin.node.tracks[i].lineage = i + 1;
    origin.lineages = 2;
  }
  std::vector<Complex> exact(double p) const {
    return {{-d, std::sqrt(4.0 + 0.2 * p - d * d)}, {-d, std::sqrt(25.0 + 0.3 * p - d * d)}};
  }
  PathNode at(double p) { return planted.family.point(p, alone(exact(p))); }
  Step attempt() { return StepSolver(points, origin, reach).attempt(h).step.value(); }
  std::uint64_t passed() { return planted.family.counts.modes.passed; }

  static constexpr double h = 0.05;
  PlantedSearch planted;
  PathProblem problem;
  PointSolver points;
  StepOrigin origin;
  double d;
};

TEST(Attempt, AcceptsSmoothModesAsExtrapolatedIfThatIsAllowed) {
  Smooth smooth(0.1);
  const Step step = smooth.attempt();
  EXPECT_EQ(smooth.passed(), 2U);
  const std::vector<Complex> exact = smooth.exact(2.0 * Smooth::h);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(step.right.tracks[i].passed);
    EXPECT_LT(std::abs(step.right.tracks[i].roots[0] - exact[i]), 1e-8 * std::abs(exact[i]));
  }
}

TEST(Attempt, CorrectsWhereNothingMayPass) {
  Smooth strict(0.1);
  strict.problem.corrector.passing_error = 0.0;
  EXPECT_FALSE(strict.attempt().right.tracks[0].passed);
  Smooth first(0.1);
  first.origin.last_step = 0.0;
  EXPECT_FALSE(first.attempt().right.tracks[0].passed);
  Smooth all_at_once(0.1);
  all_at_once.problem.route = ModeRoute::state_space;
  EXPECT_FALSE(all_at_once.attempt().right.tracks[0].passed);
  Smooth on_plane(0.1);
  on_plane.planted.frame.plane = PathPlane{Vector::Zero(on_plane.origin.node.path.x.rows()), 1.0};
  EXPECT_FALSE(on_plane.attempt().right.tracks[0].passed);
}

/// Events need accurate eigenvalues: close to the imaginary axis every mode is corrected.
TEST(Attempt, CorrectsModesCloseToTheAxis) {
  Smooth close(1e-7);
  const Step step = close.attempt();
  EXPECT_EQ(close.passed(), 0U);
  EXPECT_NEAR(step.right.tracks[0].roots[0].real(), -1e-7, 1e-14);
}

}  // namespace
}  // namespace eigentrail::test::step_solver_test
