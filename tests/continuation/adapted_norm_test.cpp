// A norm in which an operator that is far from normal is small.
#include "continuation/step/ball_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <array>

#include "support/families.hpp"

namespace eigentrail::test::adapted_norm_test {
namespace {

/// The matrix of a linear map of vectors of that size.
template <class Map>
ComplexMatrix matrix_of(Eigen::Index n, const Map& map) {
  ComplexMatrix matrix = ComplexMatrix::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    ComplexVector column = matrix.col(i);
    map(column);
    matrix.col(i) = column;
  }
  return matrix;
}

double largest(const ComplexMatrix& A) {
  return Eigen::JacobiSVD<ComplexMatrix>(A).singularValues()[0];
}

ComplexMatrix random_orthonormal(Eigen::Index n, Eigen::Index columns, std::mt19937_64& engine) {
  return random_complex(n, columns, engine).householderQr().householderQ() *
         ComplexMatrix::Identity(n, columns);
}

/// S^-1 T S, with the S that balances T on the columns of Q.
ComplexMatrix balanced(const ComplexMatrix& T, const ComplexMatrix& Q) {
  const AdaptedNorm norm = AdaptedNorm::balancing(Q, T * Q, T.adjoint() * Q);
  return matrix_of(T.rows(), [&](ComplexVector& x) {
    norm.apply(x);
    x = T * x;
    norm.apply_inverse(x);
  });
}

/// T maps v to 20 u, u to 0.01 v: its square is 0.2, and a balanced norm makes the norm the root of that.
TEST(AdaptedNorm, MakesAMapThatIsFarFromNormalSmall) {
  std::mt19937_64 engine{8};
  const ComplexMatrix Q = random_orthonormal(4, 4, engine);
  const ComplexVector u = Q.col(0), v = Q.col(1);
  const ComplexMatrix T = 20.0 * u * v.adjoint() + 0.01 * v * u.adjoint();
  EXPECT_NEAR(largest(T), 20.0, 1e-12);
  EXPECT_NEAR(largest(balanced(T, u)), std::sqrt(0.2), 1e-9);
}

/// The map of a rotor with four large directions that lead into each other: v_i to a_i u_i, with a_i = 55,
/// 21, 3, 3, all else to at most 0.05. One direction alone leaves 21; four make it small.
TEST(AdaptedNorm, NeedsAllLargeDirections) {
  constexpr Eigen::Index n = 12;
  std::mt19937_64 engine{15};
  const ComplexMatrix Q = random_orthonormal(n, n, engine);
  ComplexMatrix T = ComplexMatrix::Zero(n, n);
  const std::array<double, 4> sizes{55.0, 21.0, 3.0, 3.0};
  for (int i = 0; i < 4; ++i) T += sizes[static_cast<std::size_t>(i)] * Q.col(i) * Q.col(4 + i).adjoint();
  T += 1e-3 * random_complex(n, n, engine);
  EXPECT_LT(largest(balanced(T, Q.leftCols(4))), 0.7);
  EXPECT_GT(largest(balanced(T, Q.leftCols(1))), 15.0);
}

/// No norm makes a map smaller than its eigenvalues: what is hopeless stays so.
TEST(AdaptedNorm, DoesNotGoBelowTheEigenvalues) {
  std::mt19937_64 engine{16};
  const ComplexMatrix Q = random_orthonormal(6, 6, engine);
  const ComplexMatrix T = 1.5 * Q.col(0) * Q.col(0).adjoint() + 40.0 * Q.col(0) * Q.col(1).adjoint();
  for (const Eigen::Index count : {1, 2, 6}) EXPECT_GE(largest(balanced(T, Q.leftCols(count))), 1.5);
}

}  // namespace
}  // namespace eigentrail::test::adapted_norm_test
