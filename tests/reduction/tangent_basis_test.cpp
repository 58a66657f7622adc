#include "eigentrail/reduction/tangent_basis.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "support/families.hpp"

namespace eigentrail::test::tangent_basis_test {
namespace {

constexpr double tolerance = 1e-13;

/// A(h) = [cos h, sin h, 0] and a row that moves along a cubic: series of order 4 about h = 0.
MatrixSeries turning_constraints() {
  MatrixSeries A(5, Matrix::Zero(2, 4));
  A[0] << 1, 0, 0, 0, 0.3, 0.1, 1, 0.5;
  A[1] << 0, 1, 0, 0, 0.2, -0.4, 0, 0.1;
  A[2] << -0.5, 0, 0, 0, 0, 0.3, 0.6, 0;
  A[3] << 0, -1.0 / 6, 0, 0, 0.7, 0, 0, -0.2;
  A[4] << 1.0 / 24, 0, 0, 0, 0, 0, 0, 0;
  return A;
}

TEST(TangentBasis, SeriesAnnihilatesTheConstraintsToItsOrder) {
  const MatrixSeries A = turning_constraints();
  const ConstraintFactorization constraints(A[0]);
  for (int order = 1; order <= 4; ++order) {
    TangentBasis basis = tangent_basis(constraints, Matrix());
    differentiate_basis(constraints, {A.begin(), A.end()}, order, basis);
    const auto residual = [&](double h) { return (evaluate(A, h) * evaluate(basis.T, h)).norm(); };
    EXPECT_NEAR(std::log2(residual(0.02) / residual(0.01)), order + 1.0, 0.2) << "order " << order;
  }
}

TEST(TangentBasis, FirstOrderIsEquation67) {
  const MatrixSeries A = turning_constraints();
  const ConstraintFactorization constraints(A[0]);
  TangentBasis basis = tangent_basis(constraints, Matrix());
  differentiate_basis(constraints, {A.begin(), A.end()}, 1, basis);
  const Matrix A_plus = A[0].transpose() * (A[0] * A[0].transpose()).inverse();
  EXPECT_LT((basis.T[1] + A_plus * A[1] * basis.T[0]).norm(), tolerance * 10);
  EXPECT_LT((basis.T[0].transpose() * basis.T[1]).norm(), tolerance) << "Omega_2 of Eq. (66) is zero";
}

TEST(TangentBasis, StaysCloseToThePreviousBasis) {
  const Matrix A0 = random_matrix(2, 6, 1);
  const Matrix A1 = A0 + 1e-3 * random_matrix(2, 6, 2);
  const TangentBasis first = tangent_basis(ConstraintFactorization(A0), Matrix());
  const TangentBasis next = tangent_basis(ConstraintFactorization(A1), first.T[0]);
  EXPECT_LT((next.T[0] - first.T[0]).norm(), 1e-2);
  EXPECT_LT((next.T[0].transpose() * next.T[0] - Matrix::Identity(4, 4)).norm(), tolerance);
  EXPECT_LT((A1 * next.T[0]).norm(), tolerance * A1.norm());
}

TEST(TangentBasis, FreshFactorizationAloneJumpsWhereTheAlignedBasisDoesNot) {
  // For comparison, Q2 of the factorization without alignment changes much if the same constraints are
  // written in another order and with another sign.
  const Matrix A0 = random_matrix(2, 6, 1);
  const Matrix A1 = -A0.colwise().reverse() + 1e-9 * random_matrix(2, 6, 2);
  const Matrix T0 = ConstraintFactorization(A0).null_basis();
  const ConstraintFactorization constraints(A1);
  EXPECT_GT((constraints.null_basis() - T0).norm(), 0.1);
  EXPECT_LT((tangent_basis(constraints, T0).T[0] - T0).norm(), 1e-7);
}

TEST(TangentBasis, TurnedByARightAngleStartsAfresh) {
  const Matrix previous{{1.0}, {0.0}};  // null space of [0 1]
  const TangentBasis basis = tangent_basis(ConstraintFactorization(Matrix{{1.0, 0.0}}), previous);
  EXPECT_NEAR(std::abs(basis.T[0](1, 0)), 1.0, tolerance);
}

TEST(TangentBasis, WithoutConstraintsIsTheIdentity) {
  const TangentBasis basis = tangent_basis(ConstraintFactorization(Matrix(0, 3)), Matrix());
  EXPECT_TRUE(basis.is_identity);
  EXPECT_EQ(basis.T[0], Matrix::Identity(3, 3));
}

TEST(TangentBasis, ConstantConstraintsGiveAConstantBasis) {
  const Matrix A = random_matrix(2, 5, 7);
  const ConstraintFactorization constraints(A);
  TangentBasis basis = tangent_basis(constraints, Matrix());
  differentiate_basis(constraints, {SystemMatrix(A)}, 4, basis);
  EXPECT_EQ(basis.T.size(), 1U);
}

TEST(TangentBasis, RandomChoiceSpansTheSameSpace) {
  const Matrix A = random_matrix(2, 5, 8);
  TangentBasis basis = tangent_basis(ConstraintFactorization(A), Matrix());
  const Matrix before = basis.T[0];
  randomize_basis(basis, 42);
  EXPECT_GT((basis.T[0] - before).norm(), 0.1);
  EXPECT_LT((A * basis.T[0]).norm(), tolerance * 10);
  EXPECT_LT((basis.T[0].transpose() * basis.T[0] - Matrix::Identity(3, 3)).norm(), tolerance * 10);
}

}  // namespace
}  // namespace eigentrail::test::tangent_basis_test
