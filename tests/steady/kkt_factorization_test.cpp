#include "eigentrail/steady/kkt_factorization.hpp"

#include <gtest/gtest.h>

#include "support/families.hpp"

namespace eigentrail::test::kkt_factorization_test {
namespace {

constexpr double tolerance = 1e-12;

struct System {
  Matrix K = random_matrix(7, 7, 1);
  Matrix A = random_matrix(3, 7, 2);
  Vector r = random_matrix(7, 1, 3);
  Vector g = random_matrix(3, 1, 4);

  Matrix full() const {
    const Eigen::Index n = K.rows();
    const Eigen::Index m = A.rows();
    Matrix B = Matrix::Zero(n + m, n + m);
    B.topLeftCorner(n, n) = K;
    B.topRightCorner(n, m) = A.transpose();
    B.bottomLeftCorner(m, n) = A;
    return B;
  }
};

TEST(KktFactorization, AgreesWithTheFullSystem) {
  const System system;
  Vector dx, dl;
  KktFactorization(system.K, system.A).solve(system.r, system.g, dx, dl);
  Vector right(10), found(10);
  right << system.r, system.g;
  found << dx, dl;
  EXPECT_LT((system.full().fullPivLu().solve(right) - found).norm(), tolerance * found.norm());
}

TEST(KktFactorization, RedundantConstraintsNeedNoSpecialCareWhereTheFullSystemIsSingular) {
  System system;
  Matrix A(4, 7);
  A << system.A, 2.0 * system.A.row(0) - system.A.row(2);
  Vector g(4);
  g << system.g, 2.0 * system.g[0] - system.g[2];
  Vector dx, dl, dx_single, dl_single;
  const KktFactorization redundant(system.K, A);
  EXPECT_EQ(redundant.constraints().rank(), 3);
  redundant.solve(system.r, g, dx, dl);
  KktFactorization(system.K, system.A).solve(system.r, system.g, dx_single, dl_single);
  EXPECT_LT((dx - dx_single).norm(), tolerance * dx.norm());
  EXPECT_LT((A.transpose() * dl - system.A.transpose() * dl_single).norm(), tolerance * dl.norm());
  // For comparison, elimination on the full matrix finds no nonzero pivot.
  system.A = A;
  EXPECT_LT(system.full().partialPivLu().rcond(), 1e-15);
}

TEST(KktFactorization, RigidFreedomIsLeftAlone) {
  // Two masses joined by a spring, free to move together: the solution of least norm has no rigid part.
  const Matrix K{{1.0, -1.0}, {-1.0, 1.0}};
  const KktFactorization kkt(K, Matrix(0, 2));
  EXPECT_LT(kkt.reciprocal_condition(), 1e-14);
  Vector dx, dl;
  kkt.solve(Vector{{3.0, -3.0}}, Vector(0), dx, dl);
  EXPECT_NEAR(dx[0], 1.5, tolerance);
  EXPECT_NEAR(dx[1], -1.5, tolerance);
}

TEST(KktFactorization, ConstraintsThatLeaveNoFreedomDetermineEverything) {
  const Matrix A = random_matrix(3, 3, 5);
  const Matrix K = random_matrix(3, 3, 6);
  Vector dx, dl;
  const Vector g{{1.0, 2.0, 3.0}};
  const Vector r{{-1.0, 0.5, 2.0}};
  KktFactorization(K, A).solve(r, g, dx, dl);
  EXPECT_LT((A * dx - g).norm(), tolerance * g.norm());
  EXPECT_LT((K * dx + A.transpose() * dl - r).norm(), tolerance * dl.norm() * A.norm());
}

TEST(KktFactorization, ConstraintsAloneCannotSolve) {
  EXPECT_FALSE(KktFactorization(Matrix(Matrix::Identity(2, 3))).can_solve());
}

}  // namespace
}  // namespace eigentrail::test::kkt_factorization_test
