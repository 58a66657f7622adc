// The rule by which two detected events count as the same one.
#include "continuation/events/event_log.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::event_log_test {
namespace {

Event event_at(EventKind kind, double p, Complex s, std::vector<int> modes, int node = 5) {
  Event event;
  event.kind = kind;
  event.p = p;
  event.s = s;
  event.modes = std::move(modes);
  event.node = node;
  return event;
}

class Log : public testing::Test {
 protected:
  bool has_collision_at(const Event& zero, bool located = true) const {
    return EventLog{events, range, thresholds}.has_collision_at(zero, located, 1e-3);
  }
  bool are_same(const Event& a, const Event& b) const { return are_one(a, b, 2.0, thresholds.event); }

  std::vector<Event> events;
  PathRange range{0, -1.0, 1.0};
  Thresholds thresholds;
};

TEST_F(Log, AnEventSeenFromTwoStepsIsOne) {
  const Event a = event_at(EventKind::flutter, 0.3, {0.0, 2.0}, {1});
  const Event b = event_at(EventKind::flutter, 0.3 + 1e-12, {0.0, 2.0}, {1}, 6);
  EXPECT_TRUE(are_same(a, b));
  Event later = b;
  later.node = 20;
  EXPECT_FALSE(are_same(a, later)) << "a path that turns back passes the place again";
  EXPECT_TRUE(are_one(a, later, 2.0, thresholds.event, false)) << "it cannot turn back";
}

TEST_F(Log, WhatRoundingPutsBesideTheRangeIsAtItsEnd) {
  record({events, range, thresholds},
         {event_at(EventKind::crossing, -1.0 - 1e-12, {0.0, 2.0}, {0, 1}),
          event_at(EventKind::crossing, 1.0 + 1e-6, {0.0, 3.0}, {0, 1})},
         events);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].p, -1.0);
}

TEST_F(Log, OtherModesPlacesKindsAndDirectionsAreOthers) {
  const Event a = event_at(EventKind::flutter, 0.3, {0.0, 2.0}, {1});
  EXPECT_FALSE(are_same(a, event_at(EventKind::flutter, 0.3, {0.0, 2.0}, {2})));
  EXPECT_FALSE(are_same(a, event_at(EventKind::flutter, 0.3 + 1e-7, {0.0, 2.0}, {1})));
  EXPECT_FALSE(are_same(a, event_at(EventKind::divergence, 0.3, {0.0, 2.0}, {1})));
  Event up = a;
  Event down = a;
  up.direction = 1;
  down.direction = -1;
  EXPECT_FALSE(are_same(up, down));
  EXPECT_TRUE(are_same(up, a)) << "one whose direction is not known";
}

TEST_F(Log, AVeeringIsTheSameWhicheverModesItIsTakenFor) {
  Event a = event_at(EventKind::veering, 0.3, {0.0, 2.0}, {1, 2});
  a.half_width = 1e-3;
  Event b = a;
  b.modes = {1, 3};
  EXPECT_TRUE(are_same(a, b));
  b.s = {0.0, 2.1};
  EXPECT_FALSE(are_same(a, b));
  b = a;
  b.half_width = 2e-3;
  EXPECT_FALSE(are_same(a, b));
}

TEST_F(Log, AZeroIsACollisionOnTheAxisOnlyOfItsOwnModes) {
  Event collision = event_at(EventKind::collision, 0.0, 0.0, {0, 3});
  collision.puiseux = 1.0;
  events = {collision};
  EXPECT_TRUE(has_collision_at(event_at(EventKind::divergence, 1e-13, 0.0, {0})));
  EXPECT_FALSE(has_collision_at(event_at(EventKind::divergence, 1e-13, 0.0, {1})));
  EXPECT_FALSE(has_collision_at(event_at(EventKind::flutter, 1e-13, {0.0, 2.0}, {0})));
}

/// With damping d the pair meets at s = -d, and zero lies d^2 behind.
TEST_F(Log, AZeroBehindACollisionOffTheAxisIsAnotherOne) {
  for (const double d : {1e-1, 1e-3, 1e-4}) {
    Event collision = event_at(EventKind::collision, -d * d, -d, {0, 3});
    collision.puiseux = 1.0;
    events = {collision};
    EXPECT_FALSE(has_collision_at(event_at(EventKind::divergence, 0.0, 0.0, {0}))) << d;
  }
}

TEST_F(Log, APairThatTouchesTheRealAxisStillPassesTheImaginaryOne) {
  events = {event_at(EventKind::collision, 0.0, 0.0, {0})};
  EXPECT_FALSE(has_collision_at(event_at(EventKind::flutter, 0.0, 0.0, {0})));
}

TEST_F(Log, RecordsWhatIsNewAndOnTheRange) {
  const EventLog log{events, range, thresholds};
  const Event inside = event_at(EventKind::flutter, 0.3, {0.0, 2.0}, {1});
  const Event outside = event_at(EventKind::flutter, 1.1, {0.0, 2.0}, {1});
  record(log, {inside, inside, outside}, events);
  EXPECT_EQ(events.size(), 1U);
}

TEST_F(Log, KnowsVeeringsByModesAndComplexPlace) {
  Event veering = event_at(EventKind::veering, 0.3, {0.0, 2.0}, {1, 2});
  veering.half_width = 1e-2;
  events = {veering};
  const EventLog log{events, range, thresholds};
  EXPECT_TRUE(log.knows_veering({0.30005, -1e-2}, {1, 2}));
  EXPECT_FALSE(log.knows_veering({0.30005, -1e-2}, {1, 3}));
  EXPECT_FALSE(log.knows_veering({0.3, 1.2e-2}, {1, 2}));
}

}  // namespace
}  // namespace eigentrail::test::event_log_test
