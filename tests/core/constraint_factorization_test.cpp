#include "eigentrail/core/constraint_factorization.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>
#include <ostream>
#include <string>

#include "support/families.hpp"

namespace eigentrail::test::constraint_factorization_test {
namespace {

// A few hundred roundings in an orthogonal factorization of unit rows.
constexpr double rounding = 1e-13;

/// Two unit rows in a generic plane of R^5 at the given angle.
Matrix rows_at_angle(double angle) {
  const Matrix Q = Matrix(Eigen::HouseholderQR<Matrix>(random_matrix(5, 5, 7)).householderQ());
  Matrix A(2, 5);
  A.row(0) = Q.col(0);
  A.row(1) = std::cos(angle) * Q.col(0) + std::sin(angle) * Q.col(1);
  return A;
}

struct Case {
  std::string name;
  Matrix A;
  Eigen::Index rank;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

std::vector<Case> cases() {
  const Matrix R = random_matrix(3, 7, 1);
  std::vector<Case> list = {{"one_row", (Matrix(1, 3) << 3.0, 4.0, 0.0).finished(), 1},
                            {"full_row_rank", R, 3},
                            {"square_and_regular", random_matrix(4, 4, 2), 4},
                            {"more_rows_than_columns", random_matrix(6, 4, 3), 4}};
  Matrix duplicated(5, 7);
  duplicated << R, R.row(1), R.row(0);
  list.push_back({"rows_written_twice", duplicated, 3});
  Matrix multiples(5, 7);
  multiples << R, -2.5 * R.row(1), R.row(0) + 3.0 * R.row(2);
  list.push_back({"combinations_of_other_rows", multiples, 3});
  Matrix scaled = R;
  scaled.row(1) *= 1e9;
  list.push_back({"row_in_other_units", scaled, 3});
  Matrix far_scaled = R;
  far_scaled.row(2) *= 1e18;
  list.push_back({"row_in_far_smaller_units", far_scaled, 3});
  Matrix scaled_twice = duplicated;
  scaled_twice.row(4) *= 1e-9;
  list.push_back({"row_written_twice_in_other_units", scaled_twice, 3});
  Matrix zero_row = R;
  zero_row.row(0).setZero();
  list.push_back({"zero_row", zero_row, 2});
  list.push_back({"nothing_but_zeros", Matrix::Zero(2, 4), 0});
  return list;
}

class ConstraintFactorizationOf : public testing::TestWithParam<Case> {
 protected:
  const Matrix A = GetParam().A;
  const ConstraintFactorization factorization{A};
};

TEST_P(ConstraintFactorizationOf, KnowsTheRank) {
  EXPECT_EQ(factorization.rank(), GetParam().rank);
}

TEST_P(ConstraintFactorizationOf, NullBasisIsOrthonormalAndAnnihilatedByEveryRow) {
  const Matrix& N = factorization.null_basis();
  ASSERT_EQ(N.rows(), A.cols());
  ASSERT_EQ(N.cols(), A.cols() - GetParam().rank);
  EXPECT_LT((N.transpose() * N - Matrix::Identity(N.cols(), N.cols())).norm(), rounding);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    EXPECT_LE((A.row(i) * N).norm(), rounding * A.row(i).norm()) << "row " << i;
  }
}

TEST_P(ConstraintFactorizationOf, PseudoInverseSatisfiesItsDefiningIdentities) {
  const Matrix P = factorization.pseudo_inverse_times(A);  // A+ A, the projector onto the row space
  EXPECT_LT((P - P.transpose()).norm(), rounding);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    EXPECT_LE((A.row(i) * P - A.row(i)).norm(), rounding * A.row(i).norm()) << "A A+ A = A in row " << i;
  }
  const Matrix& N = factorization.null_basis();
  EXPECT_LT((P + N * N.transpose() - Matrix::Identity(A.cols(), A.cols())).norm(), rounding);
}

TEST_P(ConstraintFactorizationOf, MultipliersBalanceTheForceInTheRowSpace) {
  const Vector force = random_matrix(A.cols(), 1, 13);
  const Vector lambda = factorization.transposed_pseudo_inverse_times(force);
  ASSERT_EQ(lambda.size(), A.rows());
  const Matrix& N = factorization.null_basis();
  const Vector unbalanced = force - A.transpose() * lambda;
  EXPECT_LE((unbalanced - N * (N.transpose() * force)).norm(), rounding * force.norm());
}

INSTANTIATE_TEST_SUITE_P(Table, ConstraintFactorizationOf, testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(ConstraintFactorization, OfOneRowHasClosedForm) {
  const ConstraintFactorization factorization((Matrix(1, 3) << 3.0, 4.0, 0.0).finished());
  const Matrix x = factorization.pseudo_inverse_times(Matrix::Constant(1, 1, 5.0));
  EXPECT_LT((x - Eigen::Vector3d(0.6, 0.8, 0.0)).norm(), rounding);
  const Vector lambda = factorization.transposed_pseudo_inverse_times(Eigen::Vector3d(6.0, 8.0, 7.0));
  EXPECT_NEAR(lambda[0], 2.0, rounding);
}

TEST(ConstraintFactorization, IndependenceIsTheAngleBetweenTwoRows) {
  for (const double angle : {1.0, 1e-3, 1e-8}) {
    const Matrix A{{2.0, 0.0, 0.0}, {3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0}};
    EXPECT_NEAR(ConstraintFactorization(A).independence(), std::sin(angle), 1e-15) << angle;
  }
  EXPECT_EQ(ConstraintFactorization(Matrix(0, 3)).independence(), 1.0);
}

TEST(ConstraintFactorization, WithoutConstraintsLeavesEverythingFree) {
  const ConstraintFactorization factorization(Matrix(0, 4));
  EXPECT_EQ(factorization.rank(), 0);
  EXPECT_EQ(factorization.null_basis(), Matrix::Identity(4, 4));
  EXPECT_EQ(factorization.pseudo_inverse_times(Matrix(0, 2)), Matrix::Zero(4, 2));
  EXPECT_EQ(factorization.transposed_pseudo_inverse_times(Vector::Ones(4)).size(), 0);
}

TEST(ConstraintFactorization, ConstraintWrittenTwiceSharesItsMultiplier) {
  Matrix A(2, 2);
  A << 3.0, 4.0, 3.0, 4.0;
  const Vector lambda = ConstraintFactorization(A).transposed_pseudo_inverse_times(Eigen::Vector2d(6.0, 8.0));
  EXPECT_NEAR(lambda[0], 1.0, rounding);
  EXPECT_NEAR(lambda[1], 1.0, rounding);
}

TEST(ConstraintFactorization, UnitsOfARowChangeOnlyItsMultiplier) {
  const double unit = 1e9;
  const Matrix A = random_matrix(3, 7, 1);
  Matrix B = A;
  B.row(1) *= unit;
  const ConstraintFactorization a(A), b(B);
  const Matrix rates = random_matrix(3, 2, 17);
  Matrix rates_in_units = rates;
  rates_in_units.row(1) *= unit;
  EXPECT_LT((a.pseudo_inverse_times(rates) - b.pseudo_inverse_times(rates_in_units)).norm(), rounding);
  const Vector force = random_matrix(7, 1, 13);
  Vector lambda = b.transposed_pseudo_inverse_times(force);
  lambda[1] *= unit;
  EXPECT_LT((a.transposed_pseudo_inverse_times(force) - lambda).norm(), rounding);
  EXPECT_LT(
      (a.null_basis() * a.null_basis().transpose() - b.null_basis() * b.null_basis().transpose()).norm(),
      rounding);
}

TEST(ConstraintFactorization, NearlyParallelRowsStayTwoConstraints) {
  for (const double angle : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    const Matrix A = rows_at_angle(angle);
    const ConstraintFactorization factorization(A);
    EXPECT_EQ(factorization.rank(), 2) << angle;
    const Vector b = Eigen::Vector2d(1.0, -0.5);
    const Matrix x = factorization.pseudo_inverse_times(b);
    // Backward stability: the residual is a rounding of A x, and |x| grows like 1 / angle.
    EXPECT_LT((A * x - b).norm(), rounding * x.norm()) << angle;
    EXPECT_LT((A * factorization.null_basis()).norm(), rounding) << angle;
  }
}

TEST(ConstraintFactorization, NearlyParallelRowsInDifferentUnitsStayTwoConstraints) {
  constexpr double angle = 1e-8;
  for (const double unit : {1e-9, 1.0, 1e9}) {
    Matrix A = rows_at_angle(angle);
    A.row(0) *= unit;
    const ConstraintFactorization factorization(A);
    EXPECT_EQ(factorization.rank(), 2) << unit;
    // For comparison, without scaling of the rows one constraint is lost if the units differ.
    Eigen::CompleteOrthogonalDecomposition<Matrix> unscaled;
    unscaled.setThreshold(ConstraintFactorization::rank_tolerance);
    unscaled.compute(A.transpose());
    EXPECT_EQ(unscaled.rank(), unit == 1.0 ? 2 : 1) << unit;
  }
}

TEST(ConstraintFactorization, SolvesNearlyParallelRowsWhereTheNormalEquationsFail) {
  // For comparison, A+ = A^T (A A^T)^-1 as written in Eq. 15 squares the condition number.
  constexpr double not_a_solution = 0.1;
  const Matrix A = rows_at_angle(1e-8);
  const ConstraintFactorization factorization(A);
  const Vector b = Eigen::Vector2d(1.0, -0.5);
  const Matrix x = factorization.pseudo_inverse_times(b);
  EXPECT_LT((A * x - b).norm(), rounding * x.norm());
  const Vector rival = A.transpose() * Eigen::FullPivLU<Matrix>(Matrix(A * A.transpose())).solve(b);
  EXPECT_FALSE((A * rival - b).norm() < not_a_solution * b.norm());

  const Vector rates = A * random_matrix(5, 1, 19);
  EXPECT_LT((A * factorization.pseudo_inverse_times(rates) - rates).norm(), rounding * rates.norm());
}

TEST(ConstraintFactorization, RowsCloserThanTheRankToleranceAreOneConstraint) {
  const Matrix A = rows_at_angle(1e-15);
  const ConstraintFactorization factorization(A);
  EXPECT_EQ(factorization.rank(), 1);
  // Two different right sides of one constraint have no solution; least squares takes their mean.
  const Vector b = Eigen::Vector2d(1.0, 0.0);
  const Vector Ax = A * factorization.pseudo_inverse_times(b);
  EXPECT_NEAR(Ax[0], 0.5, rounding);
  EXPECT_NEAR(Ax[1], 0.5, rounding);
}

}  // namespace
}  // namespace eigentrail::test::constraint_factorization_test
