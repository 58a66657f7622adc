// The methods ("routes") that compute all modes of a point give the same point. Each is used for the systems
// for which it is meant.
#include <gtest/gtest.h>

#include "eigentrail/modes/symmetric_pairs.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::mode_route_test {
namespace {

constexpr double agreement = 1e-10;  ///< of series coefficients, relative to one

/// Three masses between springs that lose stiffness: s^2 = p - (2 - sqrt 2), p - 2, p - (2 + sqrt 2).
std::string buckling(const std::string& more = "") {
  return "[trace]\nparameter = \"p\"\nfrom = 0\nto = 3\ntolerance = 1e-8\n[matrix_family]\n"
         "M = [ [[1,0,0],[0,1,0],[0,0,1]] ]\n"
         "K = [ [[2,-1,0],[-1,2,-1],[0,-1,2]], [[-1,0,0],[0,-1,0],[0,0,-1]] ]\n" +
         more;
}

/// Two rods hanging one below the other: the modes live on the tangent space of the rods' lengths.
const std::string pendulum =
    "[parameters]\nlength = 1.0\n[trace]\nparameter = \"length\"\nfrom = 1.0\nto = 1.5\n"
    "[gravity]\nacceleration = [0, 0, -9.81]\n"
    "[[point]]\nname = \"a\"\nmass = 1\nposition = [0.01, 0, -1]\n[[fixed]]\npoint = \"a\"\ncoordinate = "
    "\"y\"\n"
    "[[point]]\nname = \"b\"\nmass = 2\nposition = [0.01, 0, -2]\n[[fixed]]\npoint = \"b\"\ncoordinate = "
    "\"y\"\n"
    "[[rod]]\nfrom = [0, 0, 0]\nto = \"a\"\nlength = \"length\"\n[[rod]]\nfrom = \"a\"\nto = \"b\"\nlength = "
    "1.0\n";

struct Computed {
  PathPoint point;
  PathNode node;
};

/// The point at `to`, predicted by the pairs at `from`.
Computed compute(const Setting& setting, double from, double to, ModeRoute route) {
  PathProblem problem = setting.problem();
  problem.s_ref = 1e-3;
  RunCounts counts;
  const PathPoint start = point_from_guess(problem, from, counts);
  problem.route = route;
  Prediction prediction{to, {start.equilibrium.x, start.equilibrium.lambda, true}, {}};
  for (std::size_t i = 0; i < start.pairs.size(); ++i) {
    prediction.pairs.push_back(start.pairs[i]);
    prediction.pairs[i].Z = start.shapes(i);
  }
  Computed result;
  result.point = compute_point(problem, prediction, start.basis.T[0], counts);
  result.node = differentiate_point(problem, result.point, counts).value();
  return result;
}

void expect_same(const PathNode& a, const PathNode& b) {
  ASSERT_EQ(a.tracks.size(), b.tracks.size());
  for (std::size_t i = 0; i < a.tracks.size(); ++i) {
    EXPECT_LT((a.tracks[i].functions - b.tracks[i].functions).norm(), agreement) << i;
    for (std::size_t j = 0; j < a.tracks[i].series.Z.size(); ++j)
      EXPECT_LT((a.tracks[i].series.Z[j] - b.tracks[i].series.Z[j]).norm(), agreement) << i << " " << j;
  }
}

class ModeRoutes : public testing::TestWithParam<double> {};

TEST_P(ModeRoutes, GiveTheSamePoint) {
  const Setting setting = make_setting(buckling());
  const Computed alone = compute(setting, GetParam(), GetParam() + 0.01, ModeRoute::one_by_one);
  const Computed general = compute(setting, GetParam(), GetParam() + 0.01, ModeRoute::state_space);
  const Computed symmetric = compute(setting, GetParam(), GetParam() + 0.01, ModeRoute::symmetric);
  EXPECT_TRUE(!alone.point.all && !alone.point.symmetric);
  EXPECT_TRUE(general.point.all && !general.point.symmetric);
  EXPECT_TRUE(!symmetric.point.all && symmetric.point.symmetric);
  expect_same(alone.node, symmetric.node);
  expect_same(general.node, symmetric.node);
}

INSTANTIATE_TEST_SUITE_P(BeforeAndAfterBuckling, ModeRoutes, testing::Values(0.1, 1.2, 2.5));

TEST(ModeRoute, SymmetricServesConstrainedScenes) {
  const Setting setting = make_setting(pendulum);
  const Computed alone = compute(setting, 1.0, 1.02, ModeRoute::one_by_one);
  const Computed symmetric = compute(setting, 1.0, 1.02, ModeRoute::symmetric);
  ASSERT_TRUE(symmetric.point.symmetric);
  ASSERT_FALSE(symmetric.node.basis.is_identity);
  expect_same(alone.node, symmetric.node);
}

TEST(ModeRoute, DampedPointsAreLeftToTheStateSpace) {
  const Setting setting = make_setting(buckling("C = [ [[0.1,0,0],[0,0.2,0],[0,0,0.1]] ]\n"));
  const Computed point = compute(setting, 0.1, 0.11, ModeRoute::symmetric);
  EXPECT_TRUE(point.point.all && !point.point.symmetric);
  expect_same(compute(setting, 0.1, 0.11, ModeRoute::one_by_one).node, point.node);
}

}  // namespace
}  // namespace eigentrail::test::mode_route_test
