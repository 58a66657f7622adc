// The search for branch points on a step, and their events: the pitchfork of a pendulum in closed form, from
// both of its paths, and a fold that is none; the choice there and the search for the other path.
#include "continuation/path/branch_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/events/static_points.hpp"
#include "continuation/on_path.hpp"
#include "continuation/path/other_path.hpp"

namespace eigentrail::test::branch_points_test {
namespace {

constexpr double length = 1.5;
constexpr double critical = critical_stiffness;

Setting hanging(double from = 6.0, double to = 20.0) {
  return spring_pendulum(hanging_straight, from, to);
}

struct Bridged : OnPath {
  using OnPath::OnPath;
  bool bridge(double h, bool with_end = true) {
    std::optional<PathNode> next;
    if (with_end) next = points.follow({node, {}}, h)->node;
    return bridge_branch_point(points, frame, node, h, next ? &*next : nullptr, tries);
  }
  /// The point on the branch point, computed on the bridge.
  PathNode on_it() {
    return points.follow({node, {}}, frame.branch_point.coordinate - frame.coordinate(node))->node;
  }
  int tries = 0;
};

/// The tangent stiffness of the straight pendulum is critical - k.
TEST(SidePoint, HasSignAndLogarithmOfTheStiffness) {
  for (const double k : {10.0, 13.0, critical + 1e-3, 17.0}) {
    Bridged at(hanging(), k);
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
  Bridged at(hanging(), critical);
  const auto side = side_point(at.points, at.reduced, 1);
  ASSERT_TRUE(side);
  EXPECT_EQ(side->stiffness.sign, 0.0);
}

TEST(SidePoint, IsNoneWithoutAPointOrWithOtherFreedoms) {
  Bridged at(hanging(), 12.0);
  EXPECT_FALSE(side_point(at.points, at.reduced, 2));
  at.reduced.status = PointStatus::no_equilibrium;
  EXPECT_FALSE(side_point(at.points, at.reduced, 1));
}

TEST(BridgeBranchPoint, FindsThePlaceOnTheStraightPathInBothDirections) {
  for (const bool down : {false, true}) {
    Bridged at(down ? hanging(20.0, 6.0) : hanging(), down ? 14.0 : 12.5);
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
  Bridged at(hanging(), 12.5);
  ASSERT_TRUE(at.bridge(1.0, false));
  EXPECT_NEAR(at.frame.branch_point.p, critical, 1e-11);
}

TEST(BridgeBranchPoint, LooksALittleBeyondTheStep) {
  Bridged near(hanging(), 12.5);
  EXPECT_TRUE(near.bridge(0.5)) << "0.16 steps beyond";
  Bridged far(hanging(), 12.5);
  EXPECT_FALSE(far.bridge(0.4)) << "0.45 steps beyond";
  EXPECT_EQ(far.tries, 0);
}

TEST(BridgeBranchPoint, GivesUpAfterSomeTries) {
  Bridged at(hanging(), 12.5);
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
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const std::string position = "[" + exact_text(length * sine) + ", 0, " + exact_text(-length * cosine) + "]";
  Bridged at(spring_pendulum(position, 20.0, 6.0), k);
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
  Bridged at(pushed_pendulum({}), 0.97);
  at.take_plane();
  const PathNode behind = at.points.follow({at.node, {}}, 0.5)->node;
  ASSERT_LT(at.node.path.x(2, 0) * behind.path.x(2, 0), 0.0) << "the fold is on the step";
  const double before = at.node.pencil.K[0](0, 0);
  ASSERT_LT(before * behind.pencil.K[0](0, 0), 0.0) << "the stiffness alone would show one";
  EXPECT_FALSE(at.bridge(0.5));
  EXPECT_EQ(at.tries, 0);
}

TEST(FindBranchPoint, IsTheEventOnTheBridgeAndNowhereElse) {
  Bridged at(hanging(), 12.5);
  ASSERT_TRUE(at.bridge(1.0));
  EXPECT_TRUE(find_branch_point(at.search, at.node).events.empty());
  const FoundEvents found = find_branch_point(at.search, at.on_it());
  ASSERT_EQ(found.events.size(), 1U);
  EXPECT_EQ(found.events[0].kind, EventKind::branch_point);
  EXPECT_EQ(found.events[0].p, at.frame.branch_point.p);
  EXPECT_EQ(found.events[0].node, 4);
  EXPECT_TRUE(found.events[0].modes.empty());
}

/// The pair becomes real at s = 0 where the stiffness of the straight path vanishes.
TEST(AsStaticEvent, AZeroEigenvalueAtABranchPointIsThatPoint) {
  Bridged at(hanging(), 12.5);
  ASSERT_TRUE(at.bridge(1.0));
  const PathNode node = at.on_it();
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
  Bridged at(hanging(critical, 20.0), critical);
  const auto start = bridge_start(at.points, at.frame, at.reduced);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->status, PointStatus::computed);
  EXPECT_TRUE(at.frame.on_branch_point(
      at.frame.coordinate(start->equilibrium.x, start->equilibrium.lambda, start->p)));
  EXPECT_LT(std::abs(start->pencil.K[0](0, 0)), 1e-9);
}

TEST(BridgeStart, LeavesRegularPointsAlone) {
  for (const double k : {critical + 1e-3, 15.0}) {
    Bridged at(hanging(k, 20.0), k);
    EXPECT_FALSE(bridge_start(at.points, at.frame, at.reduced));
    EXPECT_FALSE(at.frame.bridge);
  }
}

TEST(EquilibriumMoves, WhereItDependsOnTheParameter) {
  EXPECT_TRUE(equilibrium_moves(hanging().problem()));
  const Setting family = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1]]]\nK = [[[1]], [[1]]]\n");
  EXPECT_FALSE(equilibrium_moves(family.problem()));
}

TEST(ChoiceAt, TakesTheListInOrderAndASingleOneForAll) {
  EXPECT_EQ(choice_at({}, 0), 1);
  EXPECT_EQ(choice_at({2}, 0), 2);
  EXPECT_EQ(choice_at({2}, 7), 2);
  EXPECT_EQ(choice_at({1, 3}, 0), 1);
  EXPECT_EQ(choice_at({1, 3}, 1), 3);
  EXPECT_EQ(choice_at({1, 3}, 2), 1) << "after the end of the list";
}

/// On the bridge: the other path begins tilted, and needs a plane, since there k has a minimum.
TEST(SurveyBranchPoint, FindsTheOtherPathOfAPitchfork) {
  Bridged at(hanging(10.0), 12.9, OnPath::With::modes);
  ASSERT_TRUE(at.bridge(0.4));
  const PathNode node = at.on_it();
  ASSERT_TRUE(at.frame.on_branch_point(node));
  const BranchSurvey survey = survey_branch_point(at.points, node, 1, "here");
  ASSERT_TRUE(survey.other) << survey.note;
  EXPECT_NE(survey.note.find("here"), std::string::npos);
  for (const int choice : {2, 3}) {
    const auto start = start_on_other_path(at.points, node, *survey.other, choice);
    ASSERT_TRUE(start) << choice;
    EXPECT_GT(start->next_step, 0.0);
    // The bob leaves to one side: x' at the branch point is not zero, and opposite for the two choices.
    const double side = start->node.path.x(0, 1) * start->frame.direction;
    EXPECT_GT(std::abs(side), 1e-6);
  }
}

}  // namespace
}  // namespace eigentrail::test::branch_points_test
