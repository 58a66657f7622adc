// Singular vectors: A = U diag(values) V^H with unitary U and V, for all shapes.
#include "core/singular_vectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace eigentrail::test::singular_vectors_test {
namespace {

template <class Values>
void expect_decomposes(const Values& A) {
  const auto svd = singular_vectors(A);
  const Eigen::Index count = svd.values.size();
  const double rounding = 1e-14 * (1.0 + A.norm());
  EXPECT_TRUE(svd.U.isUnitary(1e-13));
  EXPECT_TRUE(svd.V.isUnitary(1e-13));
  const Values product = svd.U.leftCols(count) * svd.values.asDiagonal() * svd.V.leftCols(count).adjoint();
  EXPECT_LT((product - A).norm(), rounding);
  for (Eigen::Index i = 1; i < count; ++i) EXPECT_GE(svd.values[i - 1], svd.values[i]);
  const auto right = right_singular_vectors(A);
  EXPECT_LT((right.values - svd.values).norm(), rounding);
  EXPECT_LT(((A * right.V).colwise().norm().transpose().head(count) - svd.values).norm(), 10.0 * rounding);
}

TEST(SingularVectors, DecomposeSquareWideAndTallMatrices) {
  for (const auto& [rows, columns] : {std::pair{4, 4}, std::pair{2, 5}, std::pair{40, 3}, std::pair{1, 1}}) {
    SCOPED_TRACE(std::to_string(rows) + " x " + std::to_string(columns));
    expect_decomposes(Matrix(Matrix::Random(rows, columns)));
    expect_decomposes(ComplexMatrix(ComplexMatrix::Random(rows, columns)));
  }
}

TEST(SingularVectors, TheLastRightOneIsTheNullVector) {
  const Matrix A{{1.0, 2.0}, {2.0, 4.0}};
  const auto svd = singular_vectors(A);
  EXPECT_NEAR(svd.values[0], 5.0, 1e-14);
  EXPECT_NEAR(svd.values[1], 0.0, 1e-15);
  EXPECT_LT((A * svd.V.col(1)).norm(), 1e-15);
}

TEST(SingularVectors, OfNothingAreEmpty) {
  EXPECT_EQ(singular_vectors(Matrix(0, 0)).values.size(), 0);
}

TEST(SingularVectors, AreNotANumberWhereTheMatrixIsNot) {
  Matrix A = Matrix::Identity(3, 3);
  A(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(singular_vectors(A).values[0]));
  EXPECT_TRUE(std::isnan(right_singular_vectors(A).V(0, 0)));
  ComplexMatrix tall = ComplexMatrix::Identity(5, 2);
  tall(4, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(right_singular_vectors(tall).values[0]));
}

}  // namespace
}  // namespace eigentrail::test::singular_vectors_test
