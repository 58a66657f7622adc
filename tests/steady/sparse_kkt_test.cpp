// The sparse method of KktFactorization compared with the null-space method.
#include "steady/sparse_kkt.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <random>

#include "eigentrail/steady/kkt_factorization.hpp"
#include "steady/constrained_chain.hpp"

namespace eigentrail::test::sparse_kkt_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr int n = ConstrainedChain::n, m = ConstrainedChain::m;

struct System : ConstrainedChain {
  explicit System(double stiffness = 1.0, std::mt19937_64&& engine = std::mt19937_64(3))
      : ConstrainedChain(engine, 0.2) {
    K *= stiffness;
  }
  void make_symmetric() { K = (0.5 * (K + K.transpose())).eval(); }
};

SystemMatrix sparse(const Matrix& values) {
  return SparseMatrix(values.sparseView());
}

struct Solution {
  Vector dx, dl;
};

Solution solve(const KktFactorization& kkt) {
  Solution solution;
  kkt.solve(Vector::LinSpaced(n, -1.0, 2.0), Vector::LinSpaced(m, 1.0, -1.0), solution.dx, solution.dl);
  return solution;
}

TEST(SparseKkt, AgreesWithTheNullSpaceRoute) {
  for (const double stiffness : {1e-6, 1.0, 1e9}) {
    const System system(stiffness);
    const KktFactorization by_sparse(sparse(system.K), sparse(system.A)), dense(system.K, system.A);
    ASSERT_TRUE(SparseKkt::factor(sparse(system.K).sparse(), sparse(system.A).sparse())) << stiffness;
    const Solution a = solve(by_sparse), b = solve(dense);
    EXPECT_TRUE(by_sparse.can_solve());
    EXPECT_LT((a.dx - b.dx).norm(), tolerance * b.dx.norm()) << stiffness;
    EXPECT_LT((a.dl - b.dl).norm(), tolerance * b.dl.norm()) << stiffness;
    EXPECT_LT(std::abs(std::log10(by_sparse.reciprocal_condition() / dense.reciprocal_condition())), 1.0);
  }
}

TEST(SparseKkt, ReciprocalConditionFallsLikeTheLeastTangentStiffness) {
  // If mu is an eigenvalue of Q2^T K Q2, K - mu I is singular on the null space of the constraints.
  System system;
  system.make_symmetric();
  const double mu = system.least().first;
  for (const double distance : {1e-2, 1e-5, 1e-8}) {
    const Matrix K = system.K - (mu - distance) * Matrix::Identity(n, n);
    const KktFactorization kkt(sparse(K), sparse(system.A));
    EXPECT_NEAR(kkt.reciprocal_condition() * K.cwiseAbs().colwise().sum().maxCoeff() / distance, 1.0, 0.2);
  }
}

TEST(SparseKkt, SingularTangentStiffnessIsLeftToTheNullSpaceRoute) {
  System system;
  const Vector free = ConstraintFactorization(system.A).null_basis().col(0);
  system.make_symmetric();
  const Matrix P = Matrix::Identity(n, n) - free * free.transpose();
  system.K = P * system.K * P;  // no force along a motion that the constraints allow
  EXPECT_FALSE(SparseKkt::factor(sparse(system.K).sparse(), sparse(system.A).sparse()));
  const KktFactorization kkt(sparse(system.K), sparse(system.A)), dense(system.K, system.A);
  EXPECT_LT(kkt.reciprocal_condition(), 1e-13);
  EXPECT_LT((solve(kkt).dx - solve(dense).dx).norm(), 1e-9 * solve(dense).dx.norm());
}

TEST(SparseKkt, RedundantConstraintsAreLeftToTheNullSpaceRoute) {
  const System system;
  Matrix A(m + 1, n);
  A << system.A, system.A.row(2) + system.A.row(3);
  const KktFactorization kkt(sparse(system.K), sparse(A));
  EXPECT_EQ(kkt.constraints().rank(), m);
  Vector dx, dl, r = Vector::Ones(n), g = Vector::Zero(m + 1);
  kkt.solve(r, g, dx, dl);
  EXPECT_LT((system.K * dx + A.transpose() * dl - r).norm(), tolerance * r.norm());
  EXPECT_LT((A * dx).norm(), tolerance * dx.norm());
}

TEST(SparseKkt, ServesWithoutConstraintsToo) {
  const System system;
  const KktFactorization kkt(sparse(system.K), sparse(Matrix(0, n)));
  Vector dx, dl;
  kkt.solve(Vector::Ones(n), Vector(0), dx, dl);
  EXPECT_LT((system.K * dx - Vector::Ones(n)).norm(), tolerance * std::sqrt(n));
  EXPECT_EQ(dl.size(), 0);
}

TEST(SparseKkt, HasTheDeterminantOfTheWholeMatrix) {
  for (const double stiffness : {1e-6, 1.0, 1e9}) {
    const System system(stiffness);
    Matrix whole = Matrix::Zero(n + m, n + m);
    whole << system.K, system.A.transpose(), system.A, Matrix::Zero(m, m);
    const Eigen::PartialPivLU<Matrix> lu(whole);
    const Vector pivots = lu.matrixLU().diagonal();
    const auto kkt = SparseKkt::factor(sparse(system.K).sparse(), sparse(system.A).sparse());
    ASSERT_TRUE(kkt);
    const LogDeterminant determinant = kkt->determinant();
    EXPECT_NEAR(determinant.logarithm, pivots.array().abs().log().sum(), 1e-10 * (n + m) * 20.0);
    EXPECT_EQ(determinant.sign, lu.permutationP().determinant() * pivots.array().sign().prod());
  }
}

/// A symmetric system whose stiffness in the allowed motions has a simple eigenvalue at zero for shift 0.
struct Vanishing {
  System system;
  double least;
  Vector kernel;

  Vanishing() {
    system.make_symmetric();
    std::tie(least, kernel) = system.least();
  }
  SparseMatrix K(double shift) const {
    return sparse(system.K - (least + shift) * Matrix::Identity(n, n)).sparse();
  }
  SparseMatrix A() const { return sparse(system.A).sparse(); }
};

TEST(SparseKkt, TheKernelIsThatOfTheAllowedMotions) {
  const Vanishing vanishing;
  const auto kernel = kkt_kernel(vanishing.K(1e-9), vanishing.A());
  ASSERT_TRUE(kernel);
  EXPECT_NEAR(std::abs(kernel->right.dot(vanishing.kernel)), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(kernel->left.dot(vanishing.kernel)), 1.0, 1e-9);
}

TEST(SparseKkt, TheSingularityTestHasASimpleZeroToTheLastDigits) {
  const Vanishing vanishing;
  const auto kernel = kkt_kernel(vanishing.K(1e-4), vanishing.A());
  ASSERT_TRUE(kernel);
  const auto test = [&](double shift) {
    return singularity_test(vanishing.K(shift), vanishing.A(), *kernel);
  };
  for (const double shift : {1e-4, 1e-8, 1e-11, -1e-11, -1e-8, -1e-4})
    EXPECT_NEAR(test(shift) / test(1e-6), shift / 1e-6, 1e-3 * std::abs(shift / 1e-6) + 1e-8) << shift;
  // Of the determinant nothing is left there: the condition is beyond what a factorization tells.
  EXPECT_FALSE(SparseKkt::factor(vanishing.K(1e-15), vanishing.A()));
}

}  // namespace
}  // namespace eigentrail::test::sparse_kkt_test
