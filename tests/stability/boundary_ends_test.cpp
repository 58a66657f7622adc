// Curves that end inside the window.
#include <gtest/gtest.h>

#include <cmath>

#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_ends_test {
namespace {

/// s^2 + P s + Q: flutter on P = 0, Q > 0, divergence on Q = 0, both zero at the origin.
TEST(BoundaryEnds, TakensBogdanov) {
  const BoundaryResult result = boundaries_of(freedoms({{"P", "Q"}}), square_window());
  const auto flutter = curves_of_kind(result, BoundaryKind::flutter);
  const auto divergence = curves_of_kind(result, BoundaryKind::divergence);
  ASSERT_EQ(flutter.size(), 1U);
  ASSERT_EQ(divergence.size(), 1U);
  const bool at_end = flutter[0].end == CurveEnd::takens_bogdanov;
  EXPECT_NE(at_end, flutter[0].begin == CurveEnd::takens_bogdanov);
  const BoundaryPoint& last = at_end ? flutter[0].points.back() : flutter[0].points.front();
  EXPECT_LT(last.place.norm(), 1e-12);
  EXPECT_EQ(last.s, Complex(0.0));
  EXPECT_LT(largest_miss(flutter[0], 500, [](const auto& at) { return at[0]; }), 1e-8);
  EXPECT_LT(largest_miss(flutter[0], 500, [](const auto& at) { return at[1] + at[3]; }), 1e-8);
  // The divergence curve continues through the point where s = 0 is a double root.
  EXPECT_EQ(divergence[0].begin, CurveEnd::edge);
  EXPECT_EQ(divergence[0].end, CurveEnd::edge);
  const auto [low, high] = divergence[0].extent();
  EXPECT_EQ(low[0], -1.0);
  EXPECT_EQ(high[0], 1.0);
  ASSERT_EQ(result.corners.size(), 1U);
  EXPECT_EQ(result.corners[0].kind, CornerKind::takens_bogdanov);
  EXPECT_LT(result.corners[0].place.norm(), 1e-12);
}

/// The same, bent and with another freedom coupled to it: tau = 0 where the coupled pair has no damping.
TEST(BoundaryEnds, TakensBogdanovOfACoupledSystem) {
  const BoundaryResult result =
      boundaries_of(plane_scene(-1.0, 1.0,
                                "M = [[[1, 0.2], [0.2, 2]]]\nC = [[[\"P + Q^2\", 0.1], [0.1, 0.5]]]\n"
                                "K = [[[\"Q - P^2\", 0.3], [-0.2, 3]]]\n"),
                    square_window());
  const auto flutter = curves_of_kind(result, BoundaryKind::flutter);
  const auto divergence = curves_of_kind(result, BoundaryKind::divergence);
  ASSERT_EQ(divergence.size(), 1U);
  EXPECT_LT(
      largest_miss(divergence[0], 500, [](const auto& at) { return 3.0 * (at[1] - at[0] * at[0]) + 0.06; }),
      1e-7);
  int ends = 0;
  for (const BoundaryCurve& curve : flutter) {
    for (const BoundaryPoint& point : curve.points) {
      // det(s^2 M + s C + K) = s (3 a + 0.5 k - 0.1 (0.3 - 0.2)) + ...: its coefficient of s vanishes.
      if ((point.flags & takens_bogdanov_flag) == 0) continue;
      ++ends;
      const double P = point.place[0];
      const double Q = point.place[1];
      EXPECT_NEAR(3.0 * (Q - P * P) + 0.06, 0.0, 1e-12);
      EXPECT_NEAR(3.0 * (P + Q * Q) + 0.5 * (Q - P * P) - 0.01, 0.0, 1e-12);
    }
  }
  EXPECT_GE(ends, 1);
  EXPECT_EQ(result.corners.size(), static_cast<std::size_t>(ends));
}

/// Damping ratio z: P^2 = 4 z^2 Q ends where the frequency vanishes, with a vertical tangent there.
TEST(BoundaryEnds, DampingRatioEndsWhereTheFrequencyVanishes) {
  BoundaryRequest request = square_window();
  request.damping_ratio = 0.4;
  const BoundaryResult result = boundaries_of(freedoms({{"P", "Q"}}), request);
  ASSERT_EQ(result.curves.size(), 1U);
  const BoundaryCurve& curve = result.curves[0];
  EXPECT_LT(largest_miss(curve, 500, [](const auto& at) { return at[0] * at[0] - 0.64 * at[1]; }), 1e-8);
  const bool at_end = curve.end == CurveEnd::takens_bogdanov;
  const BoundaryPoint& last = at_end ? curve.points.back() : curve.points.front();
  EXPECT_LT(last.place.norm(), 1e-12);
}

/// On the edge without damping all modes of Ziegler's column are on the imaginary axis. There g = 0
/// everywhere, so Newton's method cannot determine the end of the curve.
TEST(BoundaryEnds, OnAnEdgeWithoutDamping) {
  const BoundaryResult result = ziegler_boundaries(0.0, 1.0, 1e-9);
  EXPECT_EQ(result.status, BoundaryStatus::completed) << result.message;
  ASSERT_EQ(result.curves.size(), 1U);
  const BoundaryCurve& curve = result.curves[0];
  EXPECT_EQ(curve.begin, CurveEnd::edge);
  EXPECT_EQ(curve.end, CurveEnd::edge);
  EXPECT_EQ(curve.extent().first[1], 0.0);
  EXPECT_LT(
      largest_miss(curve, 500, [](const auto& at) { return at[0] - 41.0 / 28.0 - 0.5 * at[1] * at[1]; }),
      1e-8);
}

/// All modes change their stability with the sign of the damping, so Q = 0 is a boundary up to the load where
/// the modes coalesce. The parabola crosses it.
TEST(BoundaryEnds, InAnExceptionalPointBehindACrossingOfOneMode) {
  const BoundaryResult result = ziegler_boundaries(-1.0, 1.0, 1e-9);
  EXPECT_EQ(result.status, BoundaryStatus::completed) << result.message;
  ASSERT_EQ(result.curves.size(), 3U);
  int without_damping = 0;
  for (const BoundaryCurve& curve : result.curves) {
    const auto [low, high] = curve.extent();
    if (high[1] > 0.5) continue;
    ++without_damping;
    EXPECT_TRUE(curve.begin == CurveEnd::exceptional_point || curve.end == CurveEnd::exceptional_point);
    EXPECT_LT(largest_miss(curve, 500, [](const auto& at) { return at[1]; }), 1e-8);
    EXPECT_NEAR(high[0], 3.5 - std::sqrt(2.0), 1e-5);
  }
  EXPECT_EQ(without_damping, 2);
  ASSERT_EQ(result.corners.size(), 2U);
  for (const Corner& corner : result.corners) {
    EXPECT_EQ(corner.kind, CornerKind::intersection);
    EXPECT_NEAR(corner.place[0], 41.0 / 28.0, 1e-8);
    EXPECT_NEAR(corner.place[1], 0.0, 1e-8);
  }
}

/// A pendulum pushed tangentially: no equilibrium beyond a fold. With drag it stays stable up to there.
TEST(BoundaryEnds, ScenesWithoutEquilibriumSomewhereSaySo) {
  const std::string scene =
      "[parameters]\nP = 5.0\nQ = 1.0\n[trace]\nparameter = \"P\"\nfrom = 5\nto = 40\n"
      "[gravity]\nacceleration = [0, 0, -9.81]\n[[point]]\nname = \"bob\"\nmass = 2.0\n"
      "position = [0, 0, -1.5]\n[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1.5\n"
      "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n[[drag]]\npoint = \"bob\"\ncoefficient = \"Q\"\n"
      "[[follower_force]]\npoint = \"bob\"\nfrom = [0, 0, 0]\nto = \"bob\"\nmagnitude = \"P\"\n"
      "angle = 1.5707963267948966\naxis = [0, 1, 0]\n";
  BoundaryRequest request;
  request.second = "Q";
  request.from = -1.0;
  request.to = 1.0;
  const BoundaryResult result = boundaries_of(scene, request);
  EXPECT_EQ(result.status, BoundaryStatus::completed);
  EXPECT_FALSE(result.notes.empty());
  const auto flutter = curves_of_kind(result, BoundaryKind::flutter);
  ASSERT_EQ(flutter.size(), 1U);
  // No damping, no flutter: Q = 0 up to the fold at P = m g.
  EXPECT_LT(largest_miss(flutter[0], 100, [](const auto& at) { return at[1]; }), 1e-8);
  const auto [low, high] = flutter[0].extent();
  EXPECT_EQ(low[0], 5.0);
  EXPECT_NEAR(high[0], 2.0 * 9.81, 1e-3);
  const bool folds =
      flutter[0].end == CurveEnd::equilibrium_ends || flutter[0].begin == CurveEnd::equilibrium_ends ||
      flutter[0].end == CurveEnd::takens_bogdanov || flutter[0].begin == CurveEnd::takens_bogdanov;
  EXPECT_TRUE(folds) << flutter[0].end_reason << flutter[0].begin_reason;
}

}  // namespace
}  // namespace eigentrail::test::boundary_ends_test
