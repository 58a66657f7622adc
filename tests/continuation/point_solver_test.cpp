// Predicting points from the series of another, and solving for them: exact on polynomials, of the order of
// the series beyond, and empty where there is no point.
#include "continuation/point/point_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"
#include "continuation/planted_search.hpp"

namespace eigentrail::test::point_solver_test {
namespace {

constexpr double rounding = 1e-13;

/// Frequencies 2 + p + p^2 and 5 - p^3. Series have one coefficient more than the order, here p^3.
Planted polynomials() {
  return Planted::frequencies(uncoupled(Matrix{{2.0, 1.0, 1.0, 0.0}, {5.0, 0.0, 0.0, -1.0}}), 2);
}
std::vector<Complex> on_polynomials(double p) {
  return {(2.0 + p + p * p) * j, (5.0 - p * p * p) * j};
}

TEST(Predict, IsExactWhereTheSeriesIs) {
  PlantedSearch planted(polynomials());
  const PathNode node = planted.family.point(0.1, alone(on_polynomials(0.1)));
  for (const double h : {-0.5, 0.2, 0.7}) {
    const Prediction there = planted.solver.predict(all_tracks(node), h);
    const std::vector<Complex> exact = on_polynomials(0.1 + h);
    EXPECT_NEAR(there.p, 0.1 + h, rounding);
    ASSERT_EQ(there.pairs.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(std::abs(there.pairs[i].eigenvalue() - exact[i]), 1e-11);
    EXPECT_FALSE(there.known);
    EXPECT_TRUE(there.equilibrium.solved);
  }
  const Prediction one = planted.solver.predict(one_track(node, 1), 0.2);
  ASSERT_EQ(one.pairs.size(), 1U);
  EXPECT_LT(std::abs(one.pairs[0].eigenvalue() - on_polynomials(0.3)[1]), rounding);
}

TEST(Predict, KeepsChartAndRealityOfABlock) {
  PlantedSearch planted(Planted({{Matrix{{1.0}}}, {Matrix{{1.0}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}}));
  const Complex s(-0.5, std::sqrt(0.25));
  const PathNode node = planted.family.point(0.5, {{{s, std::conj(s)}, Chart::reciprocal}});
  const Prediction there = planted.solver.predict(all_tracks(node), 0.1);
  EXPECT_EQ(there.pairs[0].chart, Chart::reciprocal);
  EXPECT_TRUE(there.pairs[0].is_real);
  EXPECT_EQ(there.pairs[0].Lambda.imag().norm(), 0.0);
}

/// With order q the series have the power q + 1, and the prediction misses by the power q + 2.
TEST(Predict, HasOneOrderMoreThanTheOutput) {
  for (const int order : {1, 2, 3}) {
    PlantedSearch planted(Planted({{Matrix{{1.0}}}, {}, {Matrix{{1.0}}, Matrix{{1.0}}}}, order));
    const PathNode node = planted.family.point(0.0, alone({j}));
    const auto miss = [&](double h) {
      const Prediction there = planted.solver.predict(all_tracks(node), h);
      return std::abs(there.pairs[0].eigenvalue() - std::sqrt(1.0 + h) * j);
    };
    EXPECT_NEAR(std::log2(miss(0.1) / miss(0.05)), order + 2.0, 0.3) << order;
  }
}

/// A step to the end of the range arrives at its very number, in both directions; a step to beside it does
/// not.
TEST(Predict, ArrivesAtTheEndOfTheRangeExactly) {
  for (const double end : {0.7, -0.7}) {
    PlantedSearch planted(polynomials(), -end, end);
    const PathNode node = planted.family.point(0.1, alone(on_polynomials(0.1)));
    const auto arrives_at = [&](double p) { return planted.solver.predict(all_tracks(node), p - 0.1).p; };
    EXPECT_EQ(arrives_at(end + 1e-14), end);
    EXPECT_EQ(arrives_at(end - 1e-14), end);
    EXPECT_NE(arrives_at(end - 1e-12), end);
    // Across a plane p is no coordinate: there is no rounding to undo.
    planted.frame.plane = PathPlane{Vector::Zero(node.path.x.rows()), 1.0};
    EXPECT_NE(arrives_at(end - 5e-15), end);
    EXPECT_TRUE(planted.solver.predict(all_tracks(node), 0.1).plane);
  }
}

/// sin(angle) = p has no solution for p > 1, and the path to p = 1 is not a function of p there.
struct Pendulum : OnPath {
  explicit Pendulum(double p) : OnPath(pushed_pendulum({}), p, With::modes) {}
};

TEST(Follow, FindsNothingBeyondAFold) {
  Pendulum pendulum(0.9);
  EXPECT_TRUE(pendulum.points.follow(all_tracks(pendulum.node), 0.05));
  EXPECT_FALSE(pendulum.points.follow(all_tracks(pendulum.node), 0.2));
  const PathPoint beyond = pendulum.points.reduce(pendulum.node, 0.2);
  EXPECT_EQ(beyond.status, PointStatus::no_equilibrium);
  EXPECT_FALSE(beyond.message.empty());
}

/// In the distance across a plane the same solver goes around the fold.
TEST(Follow, GoesAroundAFoldOnPlanes) {
  Pendulum pendulum(0.97);
  pendulum.take_plane();
  const double begin = pendulum.frame.coordinate(pendulum.node);
  bool has_passed = false;
  for (const double h : {0.1, 0.2, 0.3, 0.4}) {
    // Without modes: behind the fold the pair is real.
    const auto there = pendulum.points.follow({pendulum.node, {}}, h);
    ASSERT_TRUE(there) << h;
    EXPECT_NEAR(pendulum.frame.coordinate(there->node) - begin, h, rounding);
    // On the circle, and in balance there: x = p.
    const Vector x = there->node.path.x.col(0);
    EXPECT_NEAR(x.norm(), 1.0, rounding);
    EXPECT_NEAR(x[0], there->node.p, rounding);
    has_passed = has_passed || x[2] > 0.0;
  }
  EXPECT_TRUE(has_passed) << "behind the fold the pendulum stands above its hinge";
}

TEST(Reduce, GivesThePencilWithoutModes) {
  Pendulum pendulum(0.5);
  const PathPoint there = pendulum.points.reduce(pendulum.node, 0.1);
  ASSERT_EQ(there.status, PointStatus::computed);
  EXPECT_TRUE(there.pairs.empty());
  EXPECT_NEAR(there.equilibrium.x[0], 0.6, rounding);
  // s^2 = -g cos(angle).
  EXPECT_NEAR(there.pencil.K[0](0, 0) / there.pencil.M[0](0, 0), 9.81 * 0.8, 1e-11);
}

/// On a bridge the equilibrium is the interpolant's, not that of the series.
TEST(Predict, TakesTheEquilibriumFromABridge) {
  Pendulum pendulum(0.5);
  const auto side = [&](double h) { return pendulum.points.follow(all_tracks(pendulum.node), h)->node.path; };
  const Path left = side(0.1);
  const Path right = side(0.2);
  pendulum.frame.bridge = Bridge(0.6, 0.7, left, right, pendulum.problem.traced, false);
  pendulum.frame.branch_point = {0.64, 0.64};
  const Prediction on_it = pendulum.points.predict(all_tracks(pendulum.node), 0.15);
  ASSERT_TRUE(on_it.known);
  EXPECT_NEAR(on_it.known->x(0, 0), 0.65, 1e-9);
  EXPECT_EQ(on_it.known->x.cols(), pendulum.problem.order + 2);
  EXPECT_FALSE(pendulum.points.predict(all_tracks(pendulum.node), 0.05).known);
  const Prediction at_branch_point = pendulum.points.predict(all_tracks(pendulum.node), 0.14);
  EXPECT_EQ(at_branch_point.p, 0.64);
}

TEST(EventWork, CountsFactorizationsAsThoseOfEvents) {
  RunCounts counts;
  counts.modes.factorizations = 7;
  counts.event_factorizations = 1;
  {
    const EventWork work(counts);
    counts.modes.factorizations += 5;
    {
      const EventWork inner(counts);
      counts.modes.factorizations += 2;
    }
  }
  EXPECT_EQ(counts.modes.factorizations, 7U);
  EXPECT_EQ(counts.event_factorizations, 8U);
  EXPECT_GT(counts.events_seconds, 0.0);
}

}  // namespace
}  // namespace eigentrail::test::point_solver_test
