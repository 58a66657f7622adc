// The collision of all eigenvalues of a block in one exceptional point, from series of matrices in closed
// form.
#include "continuation/events/common_collision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::common_collision_test {
namespace {

constexpr double lambda = 1e-14;  ///< error of Lambda that is assumed
constexpr double reach = 0.1;

/// A + h B about a point `beside` the one where h = 0, as a series in the distance from it.
std::vector<ComplexMatrix> about(const Matrix& A, const Matrix& B, double beside) {
  return {(A + beside * B).cast<Complex>(), B.cast<Complex>(), ComplexMatrix::Zero(A.rows(), A.cols()),
          ComplexMatrix::Zero(A.rows(), A.cols())};
}

/// 3 I + a Jordan block of size k.
Matrix jordan(int k) {
  Matrix J = 3.0 * Matrix::Identity(k, k);
  J.diagonal(1).setOnes();
  return J;
}

/// In the lower left corner: k eigenvalues that vary like the k-th root of the distance.
Matrix corner(int k) {
  Matrix B = Matrix::Zero(k, k);
  B(k - 1, 0) = 1.0;
  return B;
}

/// Below the diagonal: k eigenvalues 3 + 2 sqrt(h) cos(i pi / (k + 1)).
Matrix below(int k) {
  Matrix B = Matrix::Zero(k, k);
  B.diagonal(-1).setOnes();
  return B;
}

class CommonCollision : public testing::TestWithParam<int> {};

TEST_P(CommonCollision, OfOneCycleHasItsOrder) {
  const int k = GetParam();
  for (const double beside : {1e-3, -1e-3, 1e-9, 0.0}) {
    const auto meeting = common_collision(about(jordan(k), corner(k), beside), lambda, reach);
    ASSERT_TRUE(meeting) << beside;
    EXPECT_EQ(meeting->kind, EventKind::collision);
    EXPECT_NEAR(meeting->offset, -beside, 1e-12);
    EXPECT_EQ(meeting->cycle, k);
    EXPECT_NEAR(std::abs(meeting->puiseux), 1.0, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CommonCollision, testing::Values(3, 4, 5, 6, 8, 10));

/// Two meet where a third is 1e-3 away: the sum of the squares has a root nearby, where nothing happens.
TEST(CommonCollisions, AreNoneWhereOneStaysBeside) {
  Matrix A = jordan(3);
  A(1, 2) = 0.0;
  A(2, 2) += 1e-3;
  Matrix B = Matrix::Zero(3, 3);
  B(1, 0) = 1.0;
  // Eigenvalues 3 +- sqrt(h) and 3.001: the sum of squares about the mean is 2 h + 2e-6 / 3.
  const double root = -1e-6 / 3.0;
  EXPECT_FALSE(common_collision(about(A, B, root), lambda, reach));
}

/// Three that cross in one point are no collision.
TEST(CommonCollisions, AreNoneWhereEigenvaluesCross) {
  const Matrix A = 3.0 * Matrix::Identity(3, 3);
  const Matrix B = Vector{{1.0, -2.0, 0.5}}.asDiagonal();
  for (const double beside : {1e-3, 0.0}) EXPECT_FALSE(common_collision(about(A, B, beside), lambda, reach));
}

TEST(CommonCollisions, AreNoneBeyondTheReach) {
  EXPECT_FALSE(common_collision(about(jordan(4), below(4), 2.0 * reach), lambda, reach));
}

/// Where rounding hides the eigenvalues as far as the series is looked at, nothing can be said of them.
TEST(CommonCollisions, AreNotToldWhereRoundingHidesTheEigenvalues) {
  EXPECT_TRUE(common_collision(about(jordan(10), below(10), 0.0), lambda, reach));
  EXPECT_FALSE(common_collision(about(jordan(10), below(10), 0.0), lambda, 1e-4 * reach));
}

TEST(CommonCollisionsOnAStep, AreFoundBetweenItsEnds) {
  constexpr int k = 6;
  const auto functions = [&](double at) {
    ComplexMatrix rows(k * k, 3);
    rows.col(0) = (jordan(k) + at * below(k)).cast<Complex>().reshaped();
    rows.col(1) = below(k).cast<Complex>().reshaped();
    rows.col(2).setZero();
    return rows;
  };
  const auto places = [&](double from, double to) {
    return common_collisions_on_step(HermiteInterpolant(to - from, functions(from), functions(to)), lambda);
  };
  const auto on_step = places(-0.3, 0.7);
  ASSERT_EQ(on_step.size(), 1U);
  EXPECT_NEAR(on_step[0].t, 0.3, 1e-12);
  EXPECT_GT(on_step[0].hidden_within, 0.0);
  EXPECT_LT(on_step[0].hidden_within, 0.1);
  EXPECT_TRUE(places(0.1, 0.7).empty());
}

}  // namespace
}  // namespace eigentrail::test::common_collision_test
