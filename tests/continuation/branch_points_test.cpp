// The search for branch points on a step, and their events: the pitchfork of a pendulum in closed form, from
// both of its paths, and a fold that is none.
#include "continuation/path/branch_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "continuation/events/static_points.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::branch_points_test {
namespace {

constexpr double length = 1.5;
constexpr double critical = 2.0 * 9.81 / length;

/// Hangs from a spring that stays vertical: straight for every stiffness k, tilted for k > critical with
/// cos(angle) = critical / k.
Setting hanging(double x, double z, double from = 6.0, double to = 20.0) {
  std::ostringstream text;
  text.precision(17);
  text << "[parameters]\nk = 20.0\n[trace]\nparameter = \"k\"\nfrom = " << from << "\nto = " << to
       << "\n[gravity]\nacceleration = [0, 0, -9.81]\n[[point]]\nname = \"bob\"\nmass = 2.0\nposition = ["
       << x << ", 0, " << z << "]\n[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1.5\n[[fixed]]\n"
       << "point = \"bob\"\ncoordinate = \"y\"\n[[guided_spring]]\npoint = \"bob\"\n"
       << "direction = [0, 0, 1]\nstiffness = \"k\"\n";
  return make_setting(text.str());
}
Setting straight(double from = 6.0, double to = 20.0) {
  return hanging(0.0, -length, from, to);
}

/// A point of the path without modes, and what belongs to it.
struct OnPath {
  OnPath(Setting given, double p)
      : setting(std::move(given)),
        problem(setting.problem()),
        frame{PathRange{problem.traced, setting.options.from, setting.options.to}},
        points(problem, frame, counts),
        reduced(reduce_at(problem, p, {problem.model.initial_guess(parameters_at(problem, p)), Vector()},
                          Matrix(), counts)),
        node(differentiate_point(problem, reduced, counts).value_or(PathNode{})),
        log{events, frame.range, problem.thresholds},
        search{points, setting.options, criteria, log, 4} {
    frame.direction = setting.options.to > setting.options.from ? 1.0 : -1.0;
    frame.largest_position = reduced.equilibrium.x.norm();
  }
  void take_plane() {
    frame.plane = plane_along(node.path, problem.traced, frame.scales(), frame.direction);
    reparametrize(node, *frame.plane, problem.traced);
  }
  bool bridge(double h, bool with_end = true) {
    std::optional<PathNode> next;
    if (with_end) next = points.follow({node, {}}, h)->node;
    return bridge_branch_point(points, frame, node, h, next ? &*next : nullptr, tries);
  }
  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathFrame frame;
  PointSolver points;
  PathPoint reduced;
  PathNode node;
  std::vector<Criterion> criteria;
  std::vector<Event> events;
  EventLog log;
  EventSearch search;
  int tries = 0;
};

/// The tangent stiffness of the straight pendulum is critical - k.
TEST(SidePoint, HasSignAndLogarithmOfTheStiffness) {
  for (const double k : {10.0, 13.0, critical + 1e-3, 17.0}) {
    OnPath at(straight(), k);
    const auto side = side_point(at.points, at.reduced, 1);
    ASSERT_TRUE(side);
    EXPECT_EQ(side->coordinate, k);
    EXPECT_EQ(side->heading, 1.0);
    EXPECT_EQ(side->stiffness.sign, k < critical ? 1.0 : -1.0);
    EXPECT_NEAR(side->stiffness.logarithm, std::log(std::abs(critical - k)), 1e-10);
  }
}

/// Up to rounding, which has no sign.
TEST(SidePoint, OnTheBranchPointHasNoSign) {
  OnPath at(straight(), critical);
  const auto side = side_point(at.points, at.reduced, 1);
  ASSERT_TRUE(side);
  EXPECT_EQ(side->stiffness.sign, 0.0);
}

TEST(SidePoint, IsNoneWithoutAPointOrWithOtherFreedoms) {
  OnPath at(straight(), 12.0);
  EXPECT_FALSE(side_point(at.points, at.reduced, 2));
  at.reduced.status = PointStatus::no_equilibrium;
  EXPECT_FALSE(side_point(at.points, at.reduced, 1));
}

TEST(BridgeBranchPoint, FindsThePlaceOnTheStraightPathInBothDirections) {
  for (const bool down : {false, true}) {
    OnPath at(down ? straight(20.0, 6.0) : straight(), down ? 14.0 : 12.5);
    ASSERT_TRUE(at.bridge(down ? -1.5 : 1.0));
    EXPECT_NEAR(at.frame.branch_point.p, critical, 1e-11);
    EXPECT_EQ(at.frame.branch_point.coordinate, at.frame.branch_point.p);
    EXPECT_TRUE(at.frame.bridge->covers(critical));
    EXPECT_EQ(at.tries, 1);
    // The path on the bridge is straight.
    const Path path = at.frame.path_on_bridge(critical, 2);
    EXPECT_LT((path.x.col(0) - Vector{{0.0, 0.0, -length}}).norm(), 1e-12);
    EXPECT_LT(path.x.rightCols(2).norm(), 1e-10);
    EXPECT_FALSE(at.bridge(critical - at.node.p)) << "a step to it: it is known";
  }
}

/// Where the end of the step is not found, the stiffness is extrapolated.
TEST(BridgeBranchPoint, DoesNotNeedTheEndOfTheStep) {
  OnPath at(straight(), 12.5);
  ASSERT_TRUE(at.bridge(1.0, false));
  EXPECT_NEAR(at.frame.branch_point.p, critical, 1e-11);
}

TEST(BridgeBranchPoint, LooksALittleBeyondTheStep) {
  OnPath near(straight(), 12.5);
  EXPECT_TRUE(near.bridge(0.5)) << "0.16 steps beyond";
  OnPath far(straight(), 12.5);
  EXPECT_FALSE(far.bridge(0.4)) << "0.45 steps beyond";
  EXPECT_EQ(far.tries, 0);
}

TEST(BridgeBranchPoint, GivesUpAfterSomeTries) {
  OnPath at(straight(), 12.5);
  at.tries = 2;
  EXPECT_TRUE(at.bridge(1.0));
  at.frame.bridge.reset();
  EXPECT_EQ(at.tries, 3);
  EXPECT_FALSE(at.bridge(1.0));
}

/// On the tilted path k has a minimum at the branch point, and det K a double root: the sign that changes is
/// that of dk/dsigma.
TEST(BridgeBranchPoint, FindsThePlaceOnTheTiltedPathThatTurnsBack) {
  const double k = 13.4;
  const double cosine = critical / k;
  OnPath at(hanging(length * std::sqrt(1.0 - cosine * cosine), -length * cosine, 20.0, 6.0), k);
  ASSERT_GT(at.node.path.x(0, 0), 0.1);
  at.take_plane();
  const double h =
      at.frame.coordinate(Vector{{0.0, 0.0, -length}}, Vector(), critical) - at.frame.coordinate(at.node);
  ASSERT_TRUE(at.bridge(1.7 * h));
  EXPECT_NEAR(at.frame.branch_point.p, critical, 1e-10);
  EXPECT_NEAR(at.frame.branch_point.coordinate - at.frame.coordinate(at.node), h, 1e-8);
  const Path path = at.frame.path_on_bridge(at.frame.branch_point.coordinate, 2);
  EXPECT_LT(std::abs(path.x(0, 0)), 1e-7);
  EXPECT_GT(std::abs(path.x(0, 1)), 1e-2) << "it goes on to the other side";
}

/// For comparison: at a fold det K changes its sign like at a branch point. Divided by dp/dsigma it does not.
TEST(BridgeBranchPoint, AFoldIsNone) {
  OnPath at(pushed_pendulum({}), 0.97);
  at.take_plane();
  const PathNode behind = at.points.follow({at.node, {}}, 0.5)->node;
  ASSERT_LT(at.node.path.x(2, 0) * behind.path.x(2, 0), 0.0) << "the fold is on the step";
  const double before = at.node.pencil.K[0](0, 0);
  ASSERT_LT(before * behind.pencil.K[0](0, 0), 0.0) << "the stiffness alone would show one";
  EXPECT_FALSE(at.bridge(0.5));
  EXPECT_EQ(at.tries, 0);
}

/// A point on the branch point, computed on the bridge.
PathNode on_it(OnPath& at) {
  return at.points.follow({at.node, {}}, at.frame.branch_point.coordinate - at.frame.coordinate(at.node))
      ->node;
}

TEST(FindBranchPoint, IsTheEventOnTheBridgeAndNowhereElse) {
  OnPath at(straight(), 12.5);
  ASSERT_TRUE(at.bridge(1.0));
  EXPECT_TRUE(find_branch_point(at.search, at.node).events.empty());
  const FoundEvents found = find_branch_point(at.search, on_it(at));
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::branch_point);
  EXPECT_EQ(found.events[0].p, at.frame.branch_point.p);
  EXPECT_EQ(found.events[0].node, 4);
  EXPECT_TRUE(found.events[0].modes.empty());
}

/// The pair becomes real at s = 0 where the stiffness of the straight path vanishes.
TEST(AsStaticEvent, AZeroEigenvalueAtABranchPointIsThatPoint) {
  OnPath at(straight(), 12.5);
  ASSERT_TRUE(at.bridge(1.0));
  const PathNode node = on_it(at);
  Event event;
  event.kind = EventKind::collision;
  event.p = at.frame.branch_point.p;
  event.modes = {0};
  event.puiseux = 0.5;
  EXPECT_TRUE(as_static_event(at.search, node, event).events.empty()) << "the bridge has its own event";
  at.frame.bridge.reset();
  const FoundEvents found = as_static_event(at.search, node, event);
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::branch_point);
  EXPECT_EQ(found.events[0].puiseux, 0.0);
  EXPECT_EQ(found.notes.size(), 1U);
  event.s = 1.0;
  EXPECT_EQ(as_static_event(at.search, node, event).events.at(0).kind, EventKind::collision) << "elsewhere";
}

TEST(BridgeStart, BeginsOnABranchPoint) {
  OnPath at(straight(critical, 20.0), critical);
  const auto start = bridge_start(at.points, at.frame, at.reduced);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->status, PointStatus::computed);
  EXPECT_TRUE(at.frame.on_branch_point(
      at.frame.coordinate(start->equilibrium.x, start->equilibrium.lambda, start->p)));
  EXPECT_LT(std::abs(start->pencil.K[0](0, 0)), 1e-9);
}

TEST(BridgeStart, LeavesRegularPointsAlone) {
  for (const double k : {critical + 1e-3, 15.0}) {
    OnPath at(straight(k, 20.0), k);
    EXPECT_FALSE(bridge_start(at.points, at.frame, at.reduced));
    EXPECT_FALSE(at.frame.bridge);
  }
}

}  // namespace
}  // namespace eigentrail::test::branch_points_test
