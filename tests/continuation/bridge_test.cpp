// The path between two points from their series, against a path in closed form.
#include "continuation/path/bridge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::bridge_test {
namespace {

/// x = (sin s, cos s), lambda = exp s, p = cosh s + 3 beside a parameter that does not change, to order 5.
Path path_at(double s) {
  Path path;
  path.x.resize(2, 6);
  path.lambda.resize(1, 6);
  path.parameters = VectorSeries::Zero(2, 6);
  path.parameters(0, 0) = 7.0;
  double factorial = 1.0;
  for (int k = 0; k < 6; ++k) {
    path.x(0, k) = std::sin(s + k * M_PI / 2.0) / factorial;
    path.x(1, k) = std::cos(s + k * M_PI / 2.0) / factorial;
    path.lambda(0, k) = std::exp(s) / factorial;
    path.parameters(1, k) = (k % 2 == 0 ? std::cosh(s) : std::sinh(s)) / factorial;
    factorial *= k + 1;
  }
  path.parameters(1, 0) += 3.0;
  return path;
}

TEST(Bridge, IsThePathBetweenItsEnds) {
  const Bridge bridge(-0.1, 0.12, path_at(-0.1), path_at(0.12), 1, true);
  EXPECT_TRUE(bridge.covers(0.0));
  EXPECT_FALSE(bridge.covers(0.13));
  EXPECT_LT(bridge.error({1.0, 1.0, 1.0}), 1e-13);
  for (const double s : {-0.1, -0.03, 0.0, 0.07, 0.12}) {
    const Path found = bridge.path(s, 4);
    const Path expected = path_at(s);
    // Each derivative costs about a digit and a half on a bridge of this length.
    for (int k = 0; k <= 4; ++k) {
      const double accuracy = 1e-14 * std::pow(40.0, k);
      EXPECT_LT((found.x.col(k) - expected.x.col(k)).norm(), accuracy) << s << " order " << k;
      EXPECT_NEAR(found.lambda(0, k), expected.lambda(0, k), accuracy) << s << " order " << k;
      EXPECT_NEAR(found.parameters(1, k), expected.parameters(1, k), accuracy) << s << " order " << k;
    }
    EXPECT_EQ(found.parameters(0, 0), 7.0);
    EXPECT_EQ(found.parameters(0, 1), 0.0);
  }
}

TEST(Bridge, AlongTheParameterHasItAsCoordinate) {
  const Bridge bridge(2.0, 2.1, path_at(0.0), path_at(0.1), 1, false);
  const Path found = bridge.path(2.04, 3);
  EXPECT_EQ(found.parameters(1, 0), 2.04);
  EXPECT_EQ(found.parameters(1, 1), 1.0);
  EXPECT_EQ(found.parameters(1, 2), 0.0);
}

/// Between points of two paths that cross, the terms of the interpolant do not fall.
TEST(Bridge, BetweenTwoPathsIsSeen) {
  Path other = path_at(0.12);
  other.x.row(0).setZero();
  const Bridge bridge(-0.1, 0.12, path_at(-0.1), other, 1, true);
  EXPECT_GT(bridge.error({1.0, 1.0, 1.0}), 1e-3);
}

}  // namespace
}  // namespace eigentrail::test::bridge_test
