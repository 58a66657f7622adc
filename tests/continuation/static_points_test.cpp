// Folds and branch points at a point of the path.
#include "continuation/events/static_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/events/event_search.hpp"
#include "continuation/step/step_solver.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::static_points_test {
namespace {

/// sin(angle) = p with a fold at p = 1, followed on planes.
struct Pendulum {
  explicit Pendulum(double p)
      : setting(pushed_pendulum({})),
        problem(setting.problem()),
        frame{PathRange{problem.traced, 0.0, 1.2}},
        points(problem, frame, counts),
        log{events, frame.range, problem.thresholds},
        search{points, setting.options, criteria, log, 3} {
    node = differentiate_point(problem, point_from_guess(problem, p, counts), counts).value();
    frame.largest_position = 1.0;
    frame.plane = plane_along(node.path, problem.traced, frame.scales(), 1.0);
    reparametrize(node, *frame.plane, problem.traced);
  }
  /// The point on the fold, by Newton's method on dp/dsigma.
  PathNode on_fold() {
    PathNode here = node;
    here.tracks.clear();
    for (int i = 0; i < 12; ++i) {
      const double h = fold_distance(frame, here);
      here = points.follow({here, {}}, h)->node;
    }
    return here;
  }
  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathFrame frame;
  PointSolver points;
  std::vector<Criterion> criteria;
  std::vector<Event> events;
  EventLog log;
  EventSearch search;
  PathNode node;
};

TEST(FindFold, RecordsThePlaceWhereThePathTurnsBack) {
  Pendulum pendulum(0.97);
  const PathNode fold = pendulum.on_fold();
  const FoundEvents found = find_fold(pendulum.search, fold, 0.1);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::fold);
  EXPECT_NEAR(found.events[0].p, 1.0, 1e-12);
  EXPECT_EQ(found.events[0].node, 3);
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
