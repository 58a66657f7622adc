// The separation of blocks of eigenvalues, against the singular values of the Sylvester operator.
#include "continuation/step/inverse_distance.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "support/families.hpp"

namespace eigentrail::test::inverse_distance_test {
namespace {

/// Norm of the inverse of X -> A X - X B, from its matrix for vec X.
double by_singular_values(const ComplexMatrix& A, const ComplexMatrix& B) {
  const Eigen::Index m = A.rows();
  const Eigen::Index k = B.rows();
  ComplexMatrix system = ComplexMatrix::Zero(m * k, m * k);
  for (Eigen::Index j = 0; j < k; ++j) {
    system.block(j * m, j * m, m, m) += A;
    for (Eigen::Index i = 0; i < k; ++i)
      system.block(j * m, i * m, m, m) -= B(i, j) * ComplexMatrix::Identity(m, m);
  }
  return 1.0 / Eigen::JacobiSVD<ComplexMatrix>(system).singularValues().tail(1)[0];
}

TEST(InverseDistance, IsExactForTwoNumbers) {
  const ComplexMatrix a = ComplexMatrix::Constant(1, 1, {3.0, 1.0});
  const ComplexMatrix b = ComplexMatrix::Constant(1, 1, {0.0, -3.0});
  EXPECT_DOUBLE_EQ(inverse_distance(a, b), 0.2);
  EXPECT_EQ(inverse_distance(a, a), 1e100);
}

TEST(InverseDistance, IsAboveTheNormAndCloseToIt) {
  std::mt19937_64 engine{3};
  for (const Eigen::Index m : {1, 2, 5, 8}) {
    for (const Eigen::Index k : {1, 2, 7}) {
      if (m * k == 1) continue;
      const ComplexMatrix A = triangular_form(random_complex(m, m, engine));
      const ComplexMatrix B =
          triangular_form(random_complex(k, k, engine) + Complex(0.0, 2.0) * ComplexMatrix::Identity(k, k));
      const double exact = by_singular_values(A, B);
      EXPECT_GE(inverse_distance(A, B), 0.9 * exact) << m << " " << k;
      EXPECT_LE(inverse_distance(A, B), 1.3 * exact) << m << " " << k;
    }
  }
}

/// Eigenvalues one apart, in a matrix that is far from normal: the distance of the eigenvalues says too much.
TEST(InverseDistance, IsLargeForSensitiveEigenvalues) {
  ComplexMatrix A(2, 2);
  A << 1.0, 1000.0, 0.0, 1.0;
  const ComplexMatrix B = ComplexMatrix::Zero(1, 1);
  EXPECT_GE(inverse_distance(A, B), 0.9 * by_singular_values(A, B));
  EXPECT_GT(inverse_distance(A, B), 900.0);
}

TEST(InverseDistance, TriangularFormKeepsTheEigenvalues) {
  ComplexMatrix Lambda(2, 2);
  Lambda << 0.0, 1.0, -4.0, 0.0;
  const ComplexMatrix T = triangular_form(Lambda);
  EXPECT_EQ(T(1, 0), Complex(0.0));
  EXPECT_NEAR(std::abs(T(0, 0) + T(1, 1)), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(T(0, 0) * T(1, 1) - 4.0), 0.0, 1e-14);
}

}  // namespace
}  // namespace eigentrail::test::inverse_distance_test
