// The search for branch points on a step, where traces through them do not show it: how far it looks, and a
// fold that is none.
#include "continuation/path/branch_points.hpp"

#include <gtest/gtest.h>

#include "continuation/on_path.hpp"
#include "continuation/path/other_path.hpp"

namespace eigentrail::test::branch_points_test {
namespace {

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
  int tries = 0;
};

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

}  // namespace
}  // namespace eigentrail::test::branch_points_test
