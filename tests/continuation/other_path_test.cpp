// The choice at a branch point, and the search for the other path.
#include "continuation/path/other_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "continuation/path/branch_points.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::other_path_test {
namespace {

TEST(ChoiceAt, TakesTheListInOrderAndASingleOneForAll) {
  EXPECT_EQ(choice_at({}, 0), 1);
  EXPECT_EQ(choice_at({2}, 0), 2);
  EXPECT_EQ(choice_at({2}, 7), 2);
  EXPECT_EQ(choice_at({1, 3}, 0), 1);
  EXPECT_EQ(choice_at({1, 3}, 1), 3);
  EXPECT_EQ(choice_at({1, 3}, 2), 1) << "after the end of the list";
}

/// A pendulum on a spring that stays vertical hangs straight for every stiffness k, and tilted above
/// k = m g / l = 13.08: a pitchfork.
struct SpringPendulum {
  explicit SpringPendulum(double k)
      : setting(
            make_setting("[parameters]\nk = 20.0\n[trace]\nparameter = \"k\"\nfrom = 10\nto = 20\n"
                         "[gravity]\nacceleration = [0, 0, -9.81]\n[[point]]\nname = \"bob\"\nmass = 2.0\n"
                         "position = [0, 0, -1.5]\n[[rod]]\nfrom = [0, 0, 0]\nto = \"bob\"\nlength = 1.5\n"
                         "[[fixed]]\npoint = \"bob\"\ncoordinate = \"y\"\n[[guided_spring]]\n"
                         "point = \"bob\"\ndirection = [0, 0, 1]\nstiffness = \"k\"\n")),
        problem(setting.problem()),
        frame{PathRange{problem.traced, 10.0, 20.0}},
        points(problem, frame, counts),
        node(differentiate_point(problem, point_from_guess(problem, k, counts), counts).value()) {
    frame.largest_position = 1.5;
  }
  Setting setting;
  PathProblem problem;
  RunCounts counts;
  PathFrame frame;
  PointSolver points;
  PathNode node;
};

TEST(EquilibriumMoves, WhereItDependsOnTheParameter) {
  EXPECT_TRUE(equilibrium_moves(SpringPendulum(12.0).problem));
  const Setting family = make_setting(
      "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\n[matrix_family]\nM = [[[1]]]\nK = [[[1]], [[1]]]\n");
  EXPECT_FALSE(equilibrium_moves(family.problem()));
}

TEST(BridgeBranchPoint, BuildsABridgeOverAPitchforkOnTheStep) {
  SpringPendulum pendulum(12.9);
  const PathNode next = pendulum.points.follow({pendulum.node, {}}, 0.4)->node;
  int tries = 0;
  EXPECT_TRUE(bridge_branch_point(pendulum.points, pendulum.frame, pendulum.node, 0.4, &next, tries));
  ASSERT_TRUE(pendulum.frame.bridge);
  EXPECT_NEAR(pendulum.frame.branch_point.p, 2.0 * 9.81 / 1.5, 1e-8);
  EXPECT_EQ(tries, 1);
}

TEST(BridgeBranchPoint, BuildsNoneWhereThereIsNoBranchPoint) {
  SpringPendulum pendulum(11.0);
  const PathNode next = pendulum.points.follow({pendulum.node, {}}, 0.4)->node;
  int tries = 0;
  EXPECT_FALSE(bridge_branch_point(pendulum.points, pendulum.frame, pendulum.node, 0.4, &next, tries));
  EXPECT_FALSE(pendulum.frame.bridge);
}

/// On the bridge: the other path begins tilted, and needs a plane, since there k has a minimum.
TEST(SurveyBranchPoint, FindsTheOtherPathOfAPitchfork) {
  SpringPendulum pendulum(12.9);
  PathNode next = pendulum.points.follow({pendulum.node, {}}, 0.4)->node;
  int tries = 0;
  ASSERT_TRUE(bridge_branch_point(pendulum.points, pendulum.frame, pendulum.node, 0.4, &next, tries));
  const double h = pendulum.frame.branch_point.coordinate - pendulum.node.p;
  const PathNode at_it = pendulum.points.follow({pendulum.node, {}}, h)->node;
  ASSERT_TRUE(pendulum.frame.on_branch_point(at_it));
  const BranchSurvey survey = survey_branch_point(pendulum.points, at_it, 1, "here");
  ASSERT_TRUE(survey.other) << survey.note;
  EXPECT_NE(survey.note.find("here"), std::string::npos);
  for (const int choice : {2, 3}) {
    const auto start = start_on_other_path(pendulum.points, at_it, *survey.other, choice);
    ASSERT_TRUE(start) << choice;
    EXPECT_GT(start->next_step, 0.0);
    // The bob leaves to one side: x' at the branch point is not zero, and opposite for the two choices.
    const double side = start->node.path.x(0, 1) * start->frame.direction;
    EXPECT_GT(std::abs(side), 1e-6);
  }
}

}  // namespace
}  // namespace eigentrail::test::other_path_test
