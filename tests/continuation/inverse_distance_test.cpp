// The separation of blocks of eigenvalues.
#include "continuation/step/modal_certificate.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include "support/families.hpp"

namespace eigentrail::test::inverse_distance_test {
namespace {

TEST(InverseDistance, IsExactForTwoNumbers) {
  const ComplexMatrix a = ComplexMatrix::Constant(1, 1, {3.0, 1.0});
  const ComplexMatrix b = ComplexMatrix::Constant(1, 1, {0.0, -3.0});
  EXPECT_DOUBLE_EQ(inverse_distance(a, b), 0.2);
  EXPECT_EQ(inverse_distance(a, a), 1e100);
}

/// Of normal matrices it is the distance of the eigenvalues.
TEST(InverseDistance, IsThatOfTheEigenvaluesOfNormalMatrices) {
  std::mt19937_64 engine{3};
  const ComplexMatrix Q = random_complex(3, 3, engine).householderQr().householderQ();
  const ComplexMatrix A = Q * ComplexVector{{1.0, Complex(0.0, 2.0), -3.0}}.asDiagonal() * Q.adjoint();
  const ComplexMatrix B = ComplexVector{{5.0, Complex(0.0, 6.0)}}.asDiagonal();
  EXPECT_NEAR(inverse_distance(A, B), 0.25, 1e-14);
  EXPECT_NEAR(inverse_distance(B, A), 0.25, 1e-14);
}

TEST(InverseDistance, BoundsEverySolution) {
  std::mt19937_64 engine{3};
  for (const Eigen::Index m : {1, 2, 5, 8}) {
    for (const Eigen::Index k : {1, 2, 7}) {
      const ComplexMatrix A = random_complex(m, m, engine);
      const ComplexMatrix B =
          random_complex(k, k, engine) + Complex(0.0, 2.0) * ComplexMatrix::Identity(k, k);
      const double bound = inverse_distance(A, B);
      for (int i = 0; i < 20; ++i) {
        const ComplexMatrix X = random_complex(m, k, engine);
        EXPECT_LE(X.norm(), (1.0 + 1e-12) * bound * (A * X - X * B).norm()) << m << " " << k;
      }
    }
  }
}

/// Eigenvalues one apart, in a matrix that is far from normal: the distance of the eigenvalues says too much.
/// The inverse of A is [1, -1000; 0, 1].
TEST(InverseDistance, IsLargeForSensitiveEigenvalues) {
  ComplexMatrix A(2, 2);
  A << 1.0, 1000.0, 0.0, 1.0;
  EXPECT_NEAR(inverse_distance(A, ComplexMatrix::Zero(1, 1)), 1000.0, 0.01);
}

}  // namespace
}  // namespace eigentrail::test::inverse_distance_test
