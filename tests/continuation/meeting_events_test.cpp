// Events of eigenvalues that coincide at a point, and what is marked at the tracks.
#include "continuation/events/meeting_events.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test::meeting_events_test {
namespace {

/// Frequencies 2 + p, 2 - p (one block) and 5.
struct AtCrossing {
  AtCrossing()
      : planted(Planted::frequencies(uncoupled(Matrix{{2.0, 1.0}, {2.0, -1.0}, {5.0, 0.0}}))),
        node(planted.family.point(0.0, {{{5.0 * j}}, {{2.0 * j, 2.0 * j}}})),
        meetings(meetings_at(planted.family.problem(), planted.frame, node)) {}
  PlantedSearch planted;
  PathNode node;
  std::vector<MeetingOnEnd> meetings;
};

TEST(MeetingEvents, GiveTheCrossingWithItsModes) {
  AtCrossing at;
  const FoundEvents found = meeting_events(at.planted.search, at.node, at.meetings);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::crossing);
  EXPECT_NEAR(found.events[0].p, 0.0, 1e-14);
  EXPECT_LT(std::abs(found.events[0].s - 2.0 * j), 1e-7);
  EXPECT_EQ(found.events[0].modes, (std::vector<int>{1, 2}));
  EXPECT_TRUE(meeting_events(at.planted.search, at.node, {}).events.empty());
}

TEST(MarkDoubtful, ClearsTracksWhoseMeetingMayBeOfAnotherKind) {
  AtCrossing at;
  mark_doubtful(at.meetings, at.node);
  EXPECT_TRUE(at.node.tracks[1].told_apart);
  at.meetings[0].meeting.is_certain = false;
  mark_doubtful(at.meetings, at.node);
  EXPECT_TRUE(at.node.tracks[0].told_apart);
  EXPECT_FALSE(at.node.tracks[1].told_apart);
}

TEST(CoincidingTracks, AreThoseWithAMeetingOtherThanAVeering) {
  AtCrossing at;
  EXPECT_EQ(coinciding_tracks(at.node, at.meetings), (std::vector<bool>{false, true}));
  at.meetings[0].meeting.kind = EventKind::veering;
  EXPECT_EQ(coinciding_tracks(at.node, at.meetings), (std::vector<bool>{false, false}));
}

TEST(MarkMeetings, NotesWhichRootsTakePart) {
  AtCrossing at;
  mark_meetings(at.meetings, at.node);
  EXPECT_TRUE(at.node.tracks[0].met.empty());
  EXPECT_EQ(at.node.tracks[1].met.size(), 2U);
}

/// s^2 + 2 d s + 1 - p meets at p = 1 - d^2, s = -d: s = -d +- sqrt(p - p*) in either chart.
TEST(MeetingEvents, GiveACollisionInEitherChart) {
  constexpr double d = 0.5;
  for (const Chart chart : {Chart::finite, Chart::reciprocal}) {
    PlantedSearch planted(Planted({{Matrix{{1.0}}}, {Matrix{{2.0 * d}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}}));
    const PathNode node = planted.family.point(1.0 - d * d, {{{-d, -d}, chart}});
    const MeetingOnEnd met{
        0, {true, EventKind::collision, 0.0, 0.0, chart == Chart::finite ? 1.0 : -4.0, {0, 1}}, 7};
    const FoundEvents found = meeting_events(planted.search, node, {met});
    ASSERT_EQ(found.events.size(), 1U);
    const Event& event = found.events[0];
    EXPECT_NEAR(event.p, 1.0 - d * d, 1e-14);
    EXPECT_LT(std::abs(event.s + d), 1e-7);
    // d(1/s) = -ds / s^2: a coefficient of -4 for 1/s is one of 1 for s.
    EXPECT_LT(std::abs(event.puiseux - 1.0), 1e-6);
    EXPECT_EQ(event.retrackings, 7);
    // The mean of both s stays at -d; that of both 1/s does not stay.
    EXPECT_LT(std::abs(event.sensitivity[0]), 1e-7);
  }
}

/// One mode, which approaches its own conjugate.
TEST(MeetingEvents, OfAPairWithItselfAreNoVeering) {
  PlantedSearch planted(
      Planted({{Matrix{{1.0}}}, {Matrix{{0.2}}}, {Matrix{{0.02}}, Matrix{{0.0}}, Matrix{{1.0}}}}));
  const PathNode node = planted.family.point(0.0, {{{{-0.1, 0.1}, {-0.1, -0.1}}}});
  MeetingOnEnd met{0, {true, EventKind::veering, 0.0, 0.1, 0.0, {0, 1}}, 1};
  EXPECT_TRUE(meeting_events(planted.search, node, {met}).events.empty());
  met.meeting.kind = EventKind::collision;
  const FoundEvents found = meeting_events(planted.search, node, {met});
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].s.imag(), 0.0) << "of a pair and its conjugate the mean is real";
}

/// Frequencies 2 +- sqrt((p - 1e-5)^2 + 9e-10): a veering at a place beside the point. What is seen of it
/// from series is about right; a meeting where the pencil has none is no event.
TEST(MeetingEvents, GiveHalfWidthAndPlaceOfANarrowVeering) {
  constexpr double place = 1e-5, half_width = 3e-5;
  PlantedSearch planted(Planted::frequencies(
      {Matrix{{2.0 - place, half_width}, {half_width, 2.0 + place}}, Matrix{{1.0, 0.0}, {0.0, -1.0}}}));
  const double apart = std::hypot(place, half_width);
  const PathNode node = planted.family.point(0.0, {{{(2.0 - apart) * j, (2.0 + apart) * j}}});
  MeetingOnEnd met{0, {true, EventKind::veering, 1.01 * place, 0.999 * half_width, 0.0, {0, 1}}, 1};
  const FoundEvents found = meeting_events(planted.search, node, {met});
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_NEAR(found.events[0].half_width, half_width, 1e-9 * half_width);
  EXPECT_NEAR(found.events[0].p, place, 1e-9 * half_width);
  met.meeting.half_width = 3.0 * half_width;
  EXPECT_TRUE(meeting_events(planted.search, node, {met}).events.empty());
}

/// Where the mass is singular, eigenvalues are equal because they are infinite: 1/s = 0.
TEST(MeetingEvents, OfInfiniteEigenvaluesAreNone) {
  AtCrossing at;
  Track& track = at.node.tracks[1];
  track.pair.chart = Chart::reciprocal;
  const FoundEvents finite = meeting_events(at.planted.search, at.node, at.meetings);
  EXPECT_EQ(finite.events.size(), 1U);
  track.roots.setConstant(0.9 / at.planted.family.problem().s_max);
  EXPECT_TRUE(meeting_events(at.planted.search, at.node, at.meetings).events.empty());
}

/// Modes of the conjugate members have no number, those that are not followed neither.
TEST(MeetingEvents, OfGuardsAreNone) {
  AtCrossing at;
  at.node.tracks[1].modes = {Track::guard, Track::guard};
  EXPECT_TRUE(meeting_events(at.planted.search, at.node, at.meetings).events.empty());
}

}  // namespace
}  // namespace eigentrail::test::meeting_events_test
