// The sparse route of ConstraintFactorization against the dense one.
#include "core/sparse_constraints.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail::test::sparse_constraints_test {
namespace {

constexpr double rounding = 1e-13;

/// Rods between neighbours of a crooked chain in space, the first hinged: rows of very different length.
Matrix chain(int points, unsigned seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Matrix A = Matrix::Zero(points, 3 * points);
  for (int i = 0; i < points; ++i) {
    const Vector direction =
        std::exp(normal(engine)) * Vector::NullaryExpr(3, [&] { return normal(engine); });
    A.block(i, 3 * i, 1, 3) = direction.transpose();
    if (i > 0) A.block(i, 3 * i - 3, 1, 3) = -direction.transpose();
  }
  return A;
}

ConstraintFactorization by_sparse(const Matrix& A) {
  return ConstraintFactorization(SparseMatrix(A.sparseView()));
}

TEST(SparseConstraints, ServeIndependentRows) {
  const Matrix A = chain(40);
  const ConstraintFactorization sparse = by_sparse(A);
  EXPECT_TRUE(sparse.is_sparse());
  EXPECT_EQ(sparse.rank(), 40);
  EXPECT_FALSE(ConstraintFactorization(A).is_sparse()) << "dense matrices stay with the dense factorization";
  EXPECT_FALSE(by_sparse(Matrix(0, 5)).is_sparse());
}

TEST(SparseConstraints, AgreeWithTheDenseFactorization) {
  const Matrix A = chain(40);
  const ConstraintFactorization sparse = by_sparse(A), dense(A);
  const Matrix B = Matrix::Random(40, 3);
  const Vector force = Vector::Random(120);
  const Matrix X = dense.pseudo_inverse_times(B);
  EXPECT_LT((sparse.pseudo_inverse_times(B) - X).norm(), rounding * X.norm());
  const Vector lambda = dense.transposed_pseudo_inverse_times(force);
  EXPECT_LT((sparse.transposed_pseudo_inverse_times(force) - lambda).norm(), rounding * lambda.norm());
  const Matrix Y = Matrix::Random(120, 4);
  EXPECT_LT((sparse.allowed_part(Y) - dense.allowed_part(Y)).norm(), rounding * Y.norm());
  // Both estimate the least angle between constraints. The estimates differ because the rows are taken in
  // different orders.
  EXPECT_LT(std::abs(std::log10(sparse.independence() / dense.independence())), 1.0);
}

TEST(SparseConstraints, AllowedPartAnnihilatesEveryRow) {
  const Matrix A = chain(40);
  const Matrix Y = by_sparse(A).allowed_part(Matrix::Random(120, 10));
  const Matrix unit = A.rowwise().normalized();
  EXPECT_LT((unit * Y).cwiseAbs().maxCoeff(), rounding);
}

TEST(SparseConstraints, NullBasisIsThatOfTheDenseFactorization) {
  const Matrix A = chain(30);
  const ConstraintFactorization sparse = by_sparse(A);
  const ConstraintFactorization copy = sparse;
  const Matrix& Q2 = sparse.null_basis();
  EXPECT_EQ(Q2.cols(), 60);
  EXPECT_LT((Q2.transpose() * Q2 - Matrix::Identity(60, 60)).norm(), 10 * rounding);
  EXPECT_LT((A.rowwise().normalized() * Q2).norm(), 10 * rounding);
  EXPECT_EQ(copy.null_basis(), Q2);
}

TEST(SparseConstraints, RedundantRowsGoToTheRankRevealingFactorization) {
  Matrix A(31, 90);
  A << chain(30), Matrix::Zero(1, 90);
  A.row(30) = 2.0 * A.row(3) - A.row(17);
  const ConstraintFactorization factorization = by_sparse(A);
  EXPECT_FALSE(factorization.is_sparse());
  EXPECT_EQ(factorization.rank(), 30);
  const Vector lambda = factorization.transposed_pseudo_inverse_times(Vector::Ones(90));
  EXPECT_LT((lambda - ConstraintFactorization(A).transposed_pseudo_inverse_times(Vector::Ones(90))).norm(),
            rounding * lambda.norm());
}

TEST(SparseConstraints, RowsThatAreNearlyParallelGoThereToo) {
  for (const double angle : {1e-4, 1e-6, 1e-9}) {
    Matrix A(31, 90);
    A << chain(30), Matrix::Zero(1, 90);
    A.row(30) = A.row(3);
    A(30, 80) += angle * A.row(3).norm();
    const ConstraintFactorization factorization = by_sparse(A);
    EXPECT_FALSE(factorization.is_sparse()) << angle;
    EXPECT_EQ(factorization.rank(), 31) << angle;
  }
}

TEST(SparseConstraints, RowsOfZerosGoThereToo) {
  Matrix A = chain(30);
  A.row(5).setZero();
  EXPECT_FALSE(by_sparse(A).is_sparse());
  EXPECT_EQ(by_sparse(A).rank(), 29);
}

TEST(SparseConstraints, AtTheLimitOnlyTheRefinedSolutionKeepsItsDigits) {
  Matrix A(31, 90);
  A << chain(30), Matrix::Zero(1, 90);
  A.row(30) = A.row(3);
  A(30, 80) += 4.0 * SparseConstraints::least_independence * A.row(3).norm();
  const ConstraintFactorization sparse = by_sparse(A);
  ASSERT_TRUE(sparse.is_sparse());
  const Vector exact = ConstraintFactorization(A).pseudo_inverse_times(Vector::Ones(31));
  const double error = (sparse.pseudo_inverse_times(Vector::Ones(31)) - exact).norm() / exact.norm();
  // For comparison, the normal equations without refinement.
  const Matrix S = A.rowwise().normalized();
  const Vector right = A.rowwise().norm().cwiseInverse();
  const Vector plain = S.transpose() * (S * S.transpose()).ldlt().solve(right);
  EXPECT_LT(error, 1e-12);
  EXPECT_LT(10.0 * error, (plain - exact).norm() / exact.norm());
}

}  // namespace
}  // namespace eigentrail::test::sparse_constraints_test
