// Factors of sparse matrices against dense solutions, for every kind of matrix.
#include "core/sparse_factors.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/families.hpp"

namespace eigentrail::test::sparse_factors_test {
namespace {

/// About a third of the entries of a random matrix, and its diagonal plus `shift`.
Matrix sparse_random(Eigen::Index n, double shift, unsigned seed) {
  std::mt19937_64 engine(seed);
  Matrix A = random_matrix(n, n, engine);
  std::bernoulli_distribution keep(0.3);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!keep(engine)) A(i, j) = 0.0;
    }
    A(i, i) += shift;
  }
  return A;
}

SparseMatrix sparse(const Matrix& A) {
  return A.sparseView();
}

TEST(SparseFactors, PositiveDefiniteMatricesGetCholeskyFactors) {
  const Matrix root = sparse_random(30, 4.0, 1), A = root * root.transpose();
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::symmetric));
  EXPECT_EQ(factors.method(), "Cholesky (CHOLMOD)");
  std::mt19937_64 engine(2);
  const Matrix B = random_matrix(30, 3, engine);
  EXPECT_LT((A * factors.solve(B) - B).norm(), 1e-12 * B.norm());
  EXPECT_LT((A * factors.solve_transposed(B) - B).norm(), 1e-12 * B.norm());
  EXPECT_GT(factors.bytes(), 0U);
}

TEST(SparseFactors, IndefiniteSymmetricMatricesGetLuFactors) {
  Matrix A = sparse_random(30, 0.0, 3);
  A = (A + A.transpose()).eval();
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::symmetric));
  EXPECT_EQ(factors.method(), "LU (UMFPACK)");
  std::mt19937_64 engine(4);
  const Matrix B = random_matrix(30, 2, engine);
  EXPECT_LT((A * factors.solve(B) - B).norm(), 1e-10 * B.norm());
}

/// Without zeros on the diagonal L D L^T exists, but its small pivots would cost ten digits.
TEST(SparseFactors, IndefiniteMatricesWithSmallPivotsKeepTheirDigits) {
  constexpr Eigen::Index n = 40;
  Matrix A = Matrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    A(i, i) = i % 2 == 0 ? 1e-10 : -1.0;
    if (i > 0) A(i, i - 1) = A(i - 1, i) = 1.0 + 0.1 * static_cast<double>(i % 3);
  }
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::symmetric));
  EXPECT_EQ(factors.method(), "LU (UMFPACK)");
  std::mt19937_64 engine(14);
  const Matrix B = random_matrix(n, 2, engine);
  EXPECT_LT((A * factors.solve(B) - B).norm(), 1e-12 * B.norm());
}

TEST(SparseFactors, GeneralMatricesAreSolvedFromBothSidesForRealAndComplexVectors) {
  const Matrix A = sparse_random(40, 3.0, 5);
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::general));
  std::mt19937_64 engine(6);
  const Matrix B = random_matrix(40, 2, engine);
  const ComplexVector b = random_complex(40, 1, engine);
  EXPECT_LT((A * factors.solve(B) - B).norm(), 1e-11 * B.norm());
  EXPECT_LT((A.transpose() * factors.solve_transposed(B) - B).norm(), 1e-11 * B.norm());
  EXPECT_LT((A * factors.solve(b) - b).norm(), 1e-11 * b.norm());
  EXPECT_LT((A.transpose() * factors.solve_transposed(b) - b).norm(), 1e-11 * b.norm());
}

TEST(SparseFactors, ComplexMatricesAreSolvedFromBothSides) {
  const ComplexMatrix A = sparse_random(25, 3.0, 7).cast<Complex>() +
                          Complex(0.0, 1.0) * sparse_random(25, 1.0, 8).cast<Complex>();
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(ComplexSparseMatrix(A.sparseView())));
  EXPECT_TRUE(factors.is_complex());
  std::mt19937_64 engine(9);
  const ComplexVector b = random_complex(25, 1, engine);
  EXPECT_LT((A * factors.solve(b) - b).norm(), 1e-11 * b.norm());
  EXPECT_LT((A.transpose() * factors.solve_transposed(b) - b).norm(), 1e-11 * b.norm());
}

TEST(SparseFactors, TheSamePatternIsFactoredAgainWithOtherValues) {
  const Matrix A = sparse_random(30, 3.0, 10);
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::general));
  ASSERT_TRUE(factors.factor(sparse(2.0 * A), SparseKind::general));
  std::mt19937_64 engine(11);
  const Matrix B = random_matrix(30, 1, engine);
  EXPECT_LT((2.0 * A * factors.solve(B) - B).norm(), 1e-11 * B.norm());
}

TEST(SparseFactors, ASingularMatrixIsReported) {
  Matrix A = sparse_random(20, 3.0, 12);
  A.row(7).setZero();
  SparseFactors factors;
  EXPECT_FALSE(factors.factor(sparse(A), SparseKind::general));
}

TEST(SparseFactors, EstimatesBoundTheFactors) {
  const Matrix root = sparse_random(30, 4.0, 13), A = root * root.transpose();
  SparseFactors factors;
  const FactorEstimate estimate = factors.estimate(sparse(A), SparseKind::symmetric);
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::symmetric));
  EXPECT_EQ(estimate.method, factors.method());
  EXPECT_GT(estimate.operations, 0.0);
  EXPECT_GE(1.01 * estimate.bytes, static_cast<double>(sizeof(double) * 30 * 31 / 2) * 0.5);
}

TEST(SparseFactors, DeterminantIsThatOfTheMatrix) {
  const Matrix A = sparse_random(40, 3.0, 5);
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(A), SparseKind::general));
  const double expected = A.determinant();
  EXPECT_NEAR(factors.determinant().logarithm, std::log(std::abs(expected)), 1e-10);
  EXPECT_EQ(factors.determinant().sign, expected > 0.0 ? 1.0 : -1.0);
  Matrix exchanged = A;
  exchanged.row(0).swap(exchanged.row(1));
  ASSERT_TRUE(factors.factor(sparse(exchanged), SparseKind::general));
  EXPECT_EQ(factors.determinant().sign, expected > 0.0 ? -1.0 : 1.0);
}

TEST(SparseFactors, DeterminantOfCholeskyFactorsIsRefused) {
  SparseFactors factors;
  ASSERT_TRUE(factors.factor(sparse(Matrix::Identity(3, 3)), SparseKind::symmetric));
  EXPECT_THROW((void)factors.determinant(), std::logic_error);
}

}  // namespace
}  // namespace eigentrail::test::sparse_factors_test
