// What is kept with an event: slopes, shape and sensitivities.
#include "continuation/events/event_record.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {
namespace {

/// Frequencies 2 + p, 2.3 - p and 5 + 0.5 p.
struct Lines {
  Lines() : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.3, -1.0}, {5.0, 0.5}}))) {}
  PathNode node(const std::vector<Together>& tracks) { return planted.family.point(0.0, tracks); }
  PlantedSearch planted;
};

TEST(MeanSlope, IsThatOfTheChosenEigenvalues) {
  Lines lines;
  const PathNode node = lines.node({{{2.0 * j, 2.3 * j, 5.0 * j}}});
  const Track& track = node.tracks[0];
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j}) - j), 1e-11);
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j, 2.3 * j})), 1e-11);
  EXPECT_LT(std::abs(mean_slope(track, {2.0 * j, 2.3 * j, 5.0 * j}) - 0.5 / 3.0 * j), 1e-11);
}

TEST(MeanSlope, IsNotKnownOfOneOfTwoThatCoincide) {
  PlantedSearch planted(
      Planted::frequencies({Matrix{{2.0, 0.0}, {0.0, 2.0}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}));
  const PathNode node = planted.family.point(0.0, {{{2.0 * j, 2.0 * j}}});
  EXPECT_TRUE(std::isnan(mean_slope(node.tracks[0], {2.0 * j}).real()));
  EXPECT_LT(std::abs(mean_slope(node.tracks[0], {2.0 * j, 2.0 * j})), 1e-10);
}

TEST(KeepShape, TakesTheEigenvectorOfTheMember) {
  Lines lines;
  const PathNode node = lines.node({{{2.0 * j, 2.3 * j}}, {{5.0 * j}}});
  for (const int member : {0, 1}) {
    Event event;
    keep_shape(node, node.tracks[0], {member}, 0.05, event);
    ASSERT_EQ(event.shape.size(), 3);
    EXPECT_NEAR(std::abs(event.shape[member]), 1.0, 1e-10);
    EXPECT_NEAR(event.shape.norm(), 1.0, 1e-10);
  }
}

/// Two lines that meet at p = 0.15, as functions of p and of a shift q of the first one: dp/dq = -1/2.
TEST(ShiftOfMeeting, IsTheRatioOfTheSlopes) {
  Lines lines;
  const PathNode along_p = lines.planted.family.point(0.15, {{{2.15 * j, 2.15 * j}}});
  PlantedSearch shifted(Planted::frequencies(uncoupled(Matrix{{2.15, 1.0}, {2.15, 0.0}, {5.0, 0.0}})));
  const PathNode along_q = shifted.family.point(0.0, {{{2.15 * j, 2.15 * j}}});
  const double shift = shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::crossing, {0, 1});
  EXPECT_NEAR(shift, -0.5, 1e-3) << "at a double eigenvalue, known to the square root of rounding";
  EXPECT_TRUE(std::isnan(shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::veering, {0, 1})));
  EXPECT_TRUE(
      std::isnan(shift_of_meeting(along_p.tracks[0], along_q.tracks[0], EventKind::crossing, {0, 1, 2})));
}

TEST(SolvedPoint, IsTheOneBehindTheNode) {
  Lines lines;
  const PathNode node = lines.node(alone({2.0 * j, 2.3 * j, 5.0 * j}));
  RunCounts counts;
  const PathPoint point = solved_point(lines.planted.family.problem(), node, counts);
  EXPECT_EQ(point.status, PointStatus::computed);
  EXPECT_EQ(point.p, node.p);
}

}  // namespace
}  // namespace eigentrail::test
