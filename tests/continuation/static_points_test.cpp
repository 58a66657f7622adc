// Folds and branch points at a point of the path.
#include "continuation/events/static_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/on_path.hpp"

namespace eigentrail::test::static_points_test {
namespace {

/// sin(angle) = p with a fold at p = 1, followed on planes.
struct Pendulum : OnPath {
  explicit Pendulum(double p) : OnPath(pushed_pendulum({}), p) { take_plane(); }
};

TEST(FindFold, RecordsThePlaceWhereThePathTurnsBack) {
  Pendulum pendulum(0.97);
  const PathNode fold = pendulum.on_fold();
  const FoundEvents found = find_fold(pendulum.search, fold, 0.1);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::fold);
  EXPECT_NEAR(found.events[0].p, 1.0, 1e-12);
  EXPECT_EQ(found.events[0].node, 4);
}

TEST(FindFold, FindsNothingElsewhere) {
  Pendulum pendulum(0.9);
  EXPECT_TRUE(find_fold(pendulum.search, pendulum.node, 0.1).events.empty());
}

TEST(FindBranchPoint, NeedsABridge) {
  Pendulum pendulum(0.9);
  EXPECT_TRUE(find_branch_point(pendulum.search, pendulum.node).events.empty());
}

TEST(AsStaticEvent, LeavesOtherEventsAlone) {
  Pendulum pendulum(0.9);
  Event event;
  event.kind = EventKind::flutter;
  event.p = 0.9;
  event.s = {0.0, 2.0};
  const FoundEvents found = as_static_event(pendulum.search, pendulum.node, event);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::flutter);
}

/// At the fold the stiffness is singular: a zero eigenvalue there is the fold itself.
TEST(AsStaticEvent, DropsTheZeroEigenvalueOfAFold) {
  Pendulum pendulum(0.97);
  const PathNode fold = pendulum.on_fold();
  Event event;
  event.kind = EventKind::collision;
  event.p = fold.p;
  event.modes = {0};
  EXPECT_TRUE(as_static_event(pendulum.search, fold, event).events.empty());
}

}  // namespace
}  // namespace eigentrail::test::static_points_test
