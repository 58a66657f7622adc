// Neighbours of a followed mode that are not followed themselves.
#include "continuation/tracks/guard_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::guard_modes_test {
namespace {

TEST(AddNeighbours, AddsTheNearestThatNoTrackHas) {
  Planted family = Planted::frequencies(
      uncoupled(Matrix{{2.0, 1.0}, {2.2, -1.0}, {2.9, 0.0}, {5.0, 0.0}, {1.9, 0.3}, {9.0, 0.0}}));
  PathNode node = family.point(0.0, alone({2.0 * j, 2.9 * j}));
  add_neighbours(family.problem(), node, 0, family.counts);
  ASSERT_GT(node.tracks.size(), 2U);
  std::vector<double> added;
  for (std::size_t i = 2; i < node.tracks.size(); ++i) {
    EXPECT_EQ(node.tracks[i].modes, std::vector<int>{Track::guard});
    added.push_back(node.tracks[i].roots[0].imag());
    EXPECT_TRUE(node.tracks[i].functions.allFinite());
  }
  EXPECT_NEAR(added[0], 1.9, 1e-10);
  EXPECT_NEAR(added[1], 2.2, 1e-10);
  for (const double w : added) EXPECT_GT(std::abs(w - 2.9), 0.1) << "it is followed";
  remove_guards(node);
  EXPECT_EQ(node.tracks.size(), 2U);
}

TEST(AddNeighbours, AddsNothingWhereAllAreFollowed) {
  Planted family = Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.2, -1.0}}));
  PathNode node = family.point(0.0, alone({2.0 * j, 2.2 * j}));
  add_neighbours(family.problem(), node, 0, family.counts);
  EXPECT_EQ(node.tracks.size(), 2U);
}

/// Real eigenvalues are added as real ones: s^2 + 5 s + 4 and s^2 + 0.2 s + 4.
TEST(AddNeighbours, FindsRealEigenvalues) {
  const auto diagonal = [](double a, double b) { return Matrix(Vector{{a, b}}.asDiagonal()); };
  Planted family({{diagonal(1.0, 1.0)}, {diagonal(5.0, 0.2)}, {diagonal(4.0, 4.0)}});
  PathNode node = family.point(0.0, alone({-1.0}));
  add_neighbours(family.problem(), node, 0, family.counts);
  ASSERT_EQ(node.tracks.size(), 3U);
  bool has_real = false;
  for (std::size_t i = 1; i < 3; ++i)
    has_real = has_real || (node.tracks[i].pair.is_real && std::abs(node.tracks[i].roots[0] + 4.0) < 1e-10);
  EXPECT_TRUE(has_real);
}

/// s^2 + 2 s + 0.2 + 0.8 p, of which only the slower of two real roots is followed: it meets the other one at
/// p = 1, where the step may not have become short before the other one is seen.
TEST(GuardModes, AreFoundBeforeStepsShrinkTowardsACollision) {
  for (const std::string tolerance : {"1e-6", "1e-8", "1e-10"}) {
    SCOPED_TRACE(tolerance);
    const RecordedTrace trace =
        completed_trace(make_setting("[trace]\nparameter = \"p\"\nfrom = 0\nto = 2\n"
                                     "modes = 1\n[matrix_family]\n"
                                     "M = [[[1, 0], [0, 1]]]\n"
                                     "C = [[[2, 0], [0, 0.5]]]\n"
                                     "K = [[[0.2, 0.01], [0, 400]], [[0.8, 0], [0, 1]]]\n",
                                     {{"tolerance", tolerance}}));
    EXPECT_LT(trace.result.nodes, 40);
    ASSERT_EQ(trace.result.events.size(), 1U);
    EXPECT_EQ(trace.result.events[0].kind, EventKind::collision);
    EXPECT_NEAR(trace.result.events[0].p, 1.0, 1e-8);
  }
}

}  // namespace
}  // namespace eigentrail::test::guard_modes_test
