// A norm in which an operator that is far from normal is small.
#include "continuation/step/adapted_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "support/families.hpp"

namespace eigentrail::test {
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

TEST(AdaptedNorm, ItsMapsAreInversesAndAdjoints) {
  constexpr Eigen::Index n = 5;
  std::mt19937_64 engine{4};
  AdaptedNorm norm;
  for (const double factor : {3.0, 50.0})
    norm.stretch(random_complex(n, 1, engine).col(0).normalized(), factor);
  const ComplexMatrix S = matrix_of(n, [&](ComplexVector& x) { norm.apply(x); });
  const ComplexMatrix inverse = matrix_of(n, [&](ComplexVector& x) { norm.apply_inverse(x); });
  const ComplexMatrix adjoint = matrix_of(n, [&](ComplexVector& x) { norm.apply_adjoint(x); });
  const ComplexMatrix both = matrix_of(n, [&](ComplexVector& x) { norm.apply_inverse_adjoint(x); });
  EXPECT_LT((S * inverse - ComplexMatrix::Identity(n, n)).norm(), 1e-13);
  EXPECT_LT((S.adjoint() - adjoint).norm(), 1e-13);
  EXPECT_LT((inverse.adjoint() - both).norm(), 1e-13);
  EXPECT_LE(largest(S), norm.largest_factor() * (1.0 + 1e-12));
}

/// A maps v to 20 u, u to 0.01 v: its square is 0.2, and a stretch of u makes the norm the root of that.
TEST(AdaptedNorm, AStretchMakesAMapThatIsFarFromNormalSmall) {
  constexpr Eigen::Index n = 4;
  std::mt19937_64 engine{8};
  const ComplexMatrix Q = random_complex(n, n, engine).householderQr().householderQ();
  const ComplexVector u = Q.col(0), v = Q.col(1);
  const ComplexMatrix A = 20.0 * u * v.adjoint() + 0.01 * v * u.adjoint();
  AdaptedNorm norm;
  norm.stretch(u, std::sqrt(20.0 / 0.01));
  const ComplexMatrix scaled = matrix_of(n, [&](ComplexVector& x) {
    norm.apply(x);
    x = A * x;
    norm.apply_inverse(x);
  });
  EXPECT_NEAR(largest(A), 20.0, 1e-12);
  EXPECT_NEAR(largest(scaled), std::sqrt(0.2), 1e-12);
}

}  // namespace
}  // namespace eigentrail::test
