// Events of eigenvalues that coincide at a point, and what is marked at the tracks.
#include "continuation/events/meeting_events.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/planted_search.hpp"

namespace eigentrail::test {
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
  EXPECT_EQ(found.events[0].p, 0.0);
  EXPECT_LT(std::abs(found.events[0].s - 2.0 * j), 1e-7);
  EXPECT_EQ(found.events[0].modes, (std::vector<int>{1, 2}));
  EXPECT_TRUE(meeting_events(at.planted.search, at.node, {}).events.empty());
}

/// s^2 + s + 1 - p: a pair meets the real axis at p = 0.75, s = -1/2 +- sqrt(p - 0.75).
TEST(MeetingEvents, GiveTheCollisionWithItsPuiseuxCoefficient) {
  PlantedSearch planted(Planted({{Matrix{{1.0}}}, {Matrix{{1.0}}}, {Matrix{{1.0}}, Matrix{{-1.0}}}}));
  const PathNode node = planted.family.point(0.75, {{{-0.5, -0.5}}});
  const auto meetings = meetings_at(planted.family.problem(), planted.frame, node);
  FoundEvents found = meeting_events(planted.search, node, meetings);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::collision);
  EXPECT_NEAR(std::abs(found.events[0].puiseux), 1.0, 1e-6);
  // A second mode begins there: it belongs to the event.
  const int parent = found.events[0].modes.front();
  name_births({{parent, 7}}, found);
  EXPECT_TRUE(std::find(found.events[0].modes.begin(), found.events[0].modes.end(), 7) !=
              found.events[0].modes.end());
  const std::vector<int> modes = found.events[0].modes;
  name_births({{99, 8}}, found);
  EXPECT_EQ(found.events[0].modes, modes) << "of another parent";
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

}  // namespace
}  // namespace eigentrail::test
