// The coordinate along the path: p or the distance across a plane, how far the path goes on in it, and the
// change from one to the other near a fold in closed form.
#include "continuation/path/path_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"

namespace eigentrail::test::path_frame_test {
namespace {

constexpr double rounding = 1e-13;

/// A point on the parabola p = 1 - x^2, in the coordinate p or in x.
PathNode on_parabola(double x, bool in_p) {
  PathNode node;
  node.p = 1.0 - x * x;
  if (in_p) {
    node.path.parameters = Matrix{{node.p, 1.0}};
    const double s = -0.5 / x;  // dx/dp
    // x(p) = sqrt(1 - p): derivatives of the root.
    node.path.x = Matrix{{x, s, -0.125 / std::pow(x, 3), -0.0625 / std::pow(x, 5)}};
  } else {
    node.path.parameters = Matrix{{node.p, -2.0 * x, -1.0}};
    node.path.x = Matrix{{x, 1.0}};
  }
  node.path.lambda = Matrix::Zero(0, 1);
  return node;
}

/// The plane x = constant: its coordinate is x.
PathFrame across_x(double from = 0.0, double to = 2.0) {
  PathFrame frame{PathRange{0, from, to}};
  frame.plane = PathPlane{Vector{{1.0}}, 0.0};
  frame.largest_position = 1.0;
  return frame;
}

/// p = 1 - x^2 turns back at x = 0, which is -x away from every point: the estimate is exact.
TEST(FoldDistance, IsExactOnAParabola) {
  const PathFrame frame = across_x();
  for (const double x : {-0.7, -1e-3, 0.0, 0.3})
    EXPECT_NEAR(fold_distance(frame, on_parabola(x, false)), -x, rounding) << x;
}

TEST(Heading, IsTheSlopeOfPAndOnAFoldThatBesideIt) {
  const PathFrame frame = across_x();
  EXPECT_EQ(heading(frame, on_parabola(0.3, false), 1.0), -0.6);
  // On the fold, where the slope is rounding, it is the side asked for that decides.
  for (const double x : {0.0, 1e-10, -1e-10}) {
    EXPECT_NEAR(heading(frame, on_parabola(x, false), 0.1), -0.2, rounding);
    EXPECT_NEAR(heading(frame, on_parabola(x, false), -0.1), 0.2, rounding);
  }
}

/// A pendulum with sin(angle) = p: the series in p converge up to the fold at p = 1.
struct Pendulum : OnPath {
  explicit Pendulum(double p) : OnPath(pushed_pendulum({}), p, With::modes) {}
};

TEST(TurnToPlane, IsDoneBeforeAFoldAndNotFarFromIt) {
  Pendulum far(0.1);
  EXPECT_FALSE(turn_to_plane(far.problem, far.frame, far.node, 0.01));
  EXPECT_FALSE(far.frame.plane);
  Pendulum near(0.99);
  const double slope_in_p = near.node.s(0, 1).imag();
  const auto length = turn_to_plane(near.problem, near.frame, near.node, 0.008);
  ASSERT_TRUE(length);
  ASSERT_TRUE(near.frame.plane);
  EXPECT_EQ(near.frame.direction, 1.0);
  // The same step, and the same slope, in the other coordinate.
  const double speed = near.frame.speed(near.node);
  EXPECT_NEAR(*length, 0.008 / speed, rounding);
  EXPECT_NEAR(near.node.s(0, 1).imag(), slope_in_p * speed, 1e-11);
  EXPECT_FALSE(turn_to_plane(near.problem, near.frame, near.node, 0.008)) << "it is turned already";
}

TEST(TurnToPlane, IsNotDoneWhereTheEquilibriumIsKnownOrOnABridge) {
  Pendulum bridged(0.99);
  const Path path = bridged.node.path;
  bridged.frame.bridge = Bridge(0.98, 0.995, path, path, bridged.problem.traced, false);
  EXPECT_FALSE(turn_to_plane(bridged.problem, bridged.frame, bridged.node, 0.008));
  Pendulum known(0.99);
  known.problem.structure.known_equilibrium = true;
  EXPECT_FALSE(turn_to_plane(known.problem, known.frame, known.node, 0.008));
  Pendulum fixed(0.99);
  fixed.problem.structure.fixed_equilibrium = true;
  EXPECT_FALSE(turn_to_plane(fixed.problem, fixed.frame, fixed.node, 0.008));
}

}  // namespace
}  // namespace eigentrail::test::path_frame_test
