// No boundary is missed: closed curves between the lines (islands), curves that touch a line or an edge, and
// boundaries that do not reach an edge.
#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/core/text.hpp"
#include "stability/boundaries.hpp"

namespace eigentrail::test::boundary_completeness_test {
namespace {

/// One freedom without damping on a circle; unstable inside when `sign` is "", stable when it is "-".
std::string circle_scene(double p, double q, double radius, const std::string& sign = "") {
  const std::string damping = sign + "((P - (" + exact_text(p) + "))^2 + (Q - (" + exact_text(q) + "))^2 - " +
                              exact_text(radius * radius) + ")";
  return freedoms({{damping, "1"}});
}

void expect_circle(const BoundaryCurve& curve, double p, double q, double radius) {
  EXPECT_EQ(curve.kind, BoundaryKind::flutter);
  EXPECT_LT(
      largest_miss(curve, 500, [&](const auto& at) { return std::hypot(at[0] - p, at[1] - q) - radius; }),
      1e-8);
}

/// An island between the lines, whose distance is a third. It is found only by following an extremum (a
/// walk).
TEST(BoundaryCompleteness, SmallIslandsBetweenTheLines) {
  for (const char* sign : {"", "-"}) {
    const BoundaryResult result = boundaries_of(circle_scene(0.15, -0.18, 0.01, sign), square_window());
    ASSERT_EQ(result.curves.size(), 1U);
    EXPECT_EQ(result.seeds, 0);
    EXPECT_EQ(result.islands, 1);
    EXPECT_TRUE(result.curves[0].closed());
    expect_circle(result.curves[0], 0.15, -0.18, 0.01);
  }
}

/// For comparison, a search on the edges alone finds no change of stability.
TEST(BoundaryCompleteness, EdgesAloneSeeNoIsland) {
  BoundaryRequest request = square_window();
  request.lines = 0;
  EXPECT_EQ(boundaries_of(circle_scene(0.13, -0.21, 0.4), request).seeds, 0);
}

/// The first inner line touches the island at one point from outside.
TEST(BoundaryCompleteness, IslandThatGrazesALine) {
  const double line = -1.0 + 2.0 / 6.0;
  const BoundaryResult result = boundaries_of(circle_scene(0.1, line + 0.05, 0.05), square_window());
  ASSERT_EQ(result.curves.size(), 1U);
  EXPECT_TRUE(result.curves[0].closed());
  expect_circle(result.curves[0], 0.1, line + 0.05, 0.05);
}

/// An island that touches the edge from inside.
TEST(BoundaryCompleteness, IslandThatGrazesTheEdge) {
  const BoundaryResult result = boundaries_of(circle_scene(0.1, 0.9, 0.1), square_window());
  ASSERT_GE(result.curves.size(), 1U);
  double length = 0.0;
  for (const BoundaryCurve& curve : result.curves) {
    expect_circle(curve, 0.1, 0.9, 0.1);
    for (const BoundaryStep& step : curve.steps) length += step.length;
  }
  EXPECT_NEAR(length, std::acos(-1.0) * 0.1, 0.05 * 0.1);
}

/// A boundary that crosses one edge twice and extends only slightly into the window.
TEST(BoundaryCompleteness, ShallowBoundaryAtTheEdge) {
  const BoundaryResult result = boundaries_of(circle_scene(0.1, 1.3, 0.301), square_window());
  ASSERT_EQ(result.curves.size(), 1U);
  expect_circle(result.curves[0], 0.1, 1.3, 0.301);
  for (const BoundaryPoint* end : {&result.curves[0].points.front(), &result.curves[0].points.back()}) {
    EXPECT_EQ(end->place[1], 1.0);
    EXPECT_NE(end->flags & edge_flag, 0);
  }
}

TEST(BoundaryCompleteness, NothingToFind) {
  const BoundaryResult result = boundaries_of(freedoms({{"3 + P + Q", "1"}}), square_window());
  EXPECT_EQ(result.status, BoundaryStatus::completed);
  EXPECT_TRUE(result.curves.empty());
  EXPECT_TRUE(result.notes.empty());
}

}  // namespace
}  // namespace eigentrail::test::boundary_completeness_test
