// The dense output of boundaries compared with closed forms along the whole curve.
#include <gtest/gtest.h>

#include <cmath>

#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_closed_form_test {
namespace {

constexpr double tolerance = 1e-9;
constexpr double accurate = 1e-8;
constexpr int places = 500;

/// Internal damping: C = 0.03 I, K = [[1 + d, W / 100], [-W / 100, 1 - d]]. s^2 + 0.03 s + 1 = +-j B with
/// B^2 = W^2 / 10^4 - d^2 has a root s = j where B = 0.03: W^2 = 9 + 10^4 d^2.
TEST(BoundaryClosedForm, InternalDampingWithAnisotropy) {
  BoundaryRequest request;
  request.second = "Q";
  request.from = -0.05;
  request.to = 0.05;
  request.overrides = {{"tolerance", exact_text(tolerance)}};
  const BoundaryResult result =
      boundaries_of(plane_scene(0.0, 6.0,
                                "M = [[[1, 0], [0, 1]]]\nC = [[[0.03, 0], [0, 0.03]]]\n"
                                "K = [[[\"1 + Q\", \"0.01 * P\"], [\"-0.01 * P\", \"1 - Q\"]]]\n"),
                    request);
  ASSERT_EQ(result.curves.size(), 1U);
  const BoundaryCurve& curve = result.curves.front();
  EXPECT_EQ(curve.kind, BoundaryKind::flutter);
  EXPECT_EQ(curve.begin, CurveEnd::edge);
  EXPECT_EQ(curve.end, CurveEnd::edge);
  EXPECT_LT(largest_miss(curve, places,
                         [](const auto& at) { return at[0] - std::sqrt(9.0 + 1e4 * at[1] * at[1]); }),
            accurate);
  EXPECT_LT(largest_miss(curve, places, [](const auto& at) { return at[3] + 1.0; }), accurate);
  // It turns back in P at d = 0 and leaves through the edges d = +-0.05.
  const auto [low, high] = curve.extent();
  EXPECT_NEAR(low[0], 3.0, accurate);
  EXPECT_EQ(low[1], -0.05);
  EXPECT_EQ(high[1], 0.05);
  EXPECT_NEAR(high[0], std::sqrt(34.0), 1e-12);
  for (const BoundaryPoint& point : curve.points) EXPECT_EQ(point.others, 0);
}

/// s^2 + P s + 1: damping ratio P / 2, whatever Q; with stiffness 1 + Q / 2, P / (2 sqrt(1 + Q / 2)).
TEST(BoundaryClosedForm, DampingRatio) {
  BoundaryRequest request = square_window();
  request.damping_ratio = 0.2;
  const BoundaryResult result = boundaries_of(freedoms({{"P", "1 + Q / 2"}}), request);
  ASSERT_EQ(result.curves.size(), 1U);
  EXPECT_EQ(result.curves[0].kind, BoundaryKind::damping_ratio);
  EXPECT_LT(largest_miss(result.curves[0], places,
                         [](const auto& at) { return at[0] - 0.4 * std::sqrt(1.0 + 0.5 * at[1]); }),
            accurate);
  for (const BoundaryPoint& point : result.curves[0].points)
    EXPECT_NEAR(-point.s.real() / std::abs(point.s), 0.2, 1e-12);
}

/// The stiffness vanishes on a circle: a closed curve with turning points in both parameters.
TEST(BoundaryClosedForm, DivergenceOnACircle) {
  const BoundaryResult result =
      boundaries_of(freedoms({{"0.3", "0.25 - (P - 0.1)^2 - (Q + 0.2)^2"}, {"0.2", "3"}}), square_window());
  ASSERT_EQ(result.curves.size(), 1U);
  const BoundaryCurve& curve = result.curves.front();
  EXPECT_EQ(curve.kind, BoundaryKind::divergence);
  EXPECT_TRUE(curve.closed());
  EXPECT_LT(
      largest_miss(curve, places, [](const auto& at) { return std::hypot(at[0] - 0.1, at[1] + 0.2) - 0.5; }),
      accurate);
  const auto [low, high] = curve.extent();
  EXPECT_NEAR(low[0], -0.4, accurate);
  EXPECT_NEAR(high[1], 0.3, accurate);
}

/// Two freedoms lose their damping on the lines P = Q / 2 and P = -Q + 0.3: a corner at Q = 0.2, P = 0.1.
TEST(BoundaryClosedForm, CornerWhereAnotherModeTakesOver) {
  const BoundaryResult result =
      boundaries_of(freedoms({{"Q / 2 - P", "1"}, {"0.3 - Q - P", "4"}}), square_window());
  ASSERT_EQ(result.curves.size(), 2U);
  ASSERT_EQ(result.corners.size(), 1U);
  const Corner& corner = result.corners.front();
  EXPECT_EQ(corner.kind, CornerKind::intersection);
  EXPECT_NEAR(corner.place[0], 0.1, 1e-13);
  EXPECT_NEAR(corner.place[1], 0.2, 1e-13);
  EXPECT_EQ(corner.curves, (std::array<int, 2>{0, 1}));
  EXPECT_NEAR(std::abs(corner.s[0]) + std::abs(corner.s[1]), 3.0, 1e-12);
  // A part of either curve is not the boundary of the stable region: there the other mode is unstable.
  for (const BoundaryCurve& curve : result.curves) {
    const bool first = std::abs(std::abs(curve.points[0].s) - 1.0) < 1e-6;
    for (const BoundaryPoint& point : curve.points) {
      const double other =
          first ? 0.3 - point.place[1] - point.place[0] : point.place[1] / 2 - point.place[0];
      EXPECT_EQ(point.others, other < 0.0 ? 1 : 0);
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::boundary_closed_form_test
