// Motions of a projected scene, lifted to where its constraints have turned.
#include "eigentrail/reduction/tangent_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/families.hpp"

namespace eigentrail::test::restricted_basis_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr int pairs = 12, n = 2 * pairs, m = 8;

/// Pair i of coordinates may move along an angle that turns by rate (i + 1) h; pairs from m on are free.
SparseMatrix constraints_at(double h) {
  SparseMatrix A(m, n);
  for (int i = 0; i < m; ++i) {
    const double angle = (i + 1) * h;
    A.insert(i, 2 * i) = 3.0 * std::cos(angle);
    A.insert(i, 2 * i + 1) = 3.0 * std::sin(angle);
  }
  return A;
}

/// Two motions allowed at h = 0, orthonormal.
Motions motions() {
  const SparseMatrix A = constraints_at(0.0);
  const Matrix allowed = ConstraintFactorization(SystemMatrix(A)).allowed_part(random_matrix(n, 3, 5));
  return {Matrix(allowed.householderQr().householderQ() * Matrix::Identity(n, 3)), A};
}

TEST(RestrictedBasis, IsAllowedAndOrthonormal) {
  const Motions all = motions();
  for (const double h : {0.0, 0.05, 0.15}) {
    const SystemMatrix A = constraints_at(h);
    const auto basis = restricted_basis(all, A, ConstraintFactorization(A));
    ASSERT_TRUE(basis);
    const Matrix& T = basis->T[0];
    EXPECT_LT((A * T).norm(), tolerance) << h;
    EXPECT_LT((T.transpose() * T - Matrix::Identity(3, 3)).norm(), tolerance) << h;
  }
}

/// A motion that is allowed elsewhere is found there from its part that was allowed at the reference alone,
/// where the projection of that part would miss it.
TEST(RestrictedBasis, HoldsTheMotionsWhosePartAtTheReferenceIsKnown) {
  const SystemMatrix A = constraints_at(0.1);
  const ConstraintFactorization here(A);
  const Matrix elsewhere = here.allowed_part(random_matrix(n, 1, 5));
  const SparseMatrix B = constraints_at(0.0);
  const Matrix part = ConstraintFactorization(SystemMatrix(B)).allowed_part(elsewhere);
  const auto basis = restricted_basis({part.normalized(), B}, A, here);
  ASSERT_TRUE(basis);
  EXPECT_LT((basis->T[0] * (basis->T[0].transpose() * elsewhere) - elsewhere).norm(), tolerance);
  const Matrix projected = here.allowed_part(part).normalized();
  EXPECT_GT((projected * (projected.transpose() * elsewhere) - elsewhere).norm(), 0.05);
}

TEST(RestrictedBasis, EndsWhereAConstraintHasTurnedByARightAngle) {
  Motions all = motions();
  const double right_angle = 0.5 * 3.14159265358979 / m;  // of the last pair
  all.basis = Matrix::Zero(n, 1);
  all.basis(2 * m - 1, 0) = 1.0;
  const SystemMatrix A = constraints_at(right_angle);
  EXPECT_FALSE(restricted_basis(all, A, ConstraintFactorization(A)));
}

TEST(RestrictedBasis, IsThatOfTheMotionsWithoutConstraints) {
  const Matrix motions = Matrix::Identity(n, 2);
  const SystemMatrix none = SparseMatrix(0, n);
  const auto basis = restricted_basis({motions, SparseMatrix(0, n)}, none, ConstraintFactorization(none));
  ASSERT_TRUE(basis);
  EXPECT_EQ(basis->T[0], motions);
}

}  // namespace
}  // namespace eigentrail::test::restricted_basis_test
