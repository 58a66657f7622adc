// The second derivative of a pair's equations, against the change of the Jacobian: the equations are cubic,
// so that half the difference of the Jacobians at U + V and U - V is F''(V) exactly.
#include "continuation/step/jacobian_change.hpp"

#include <gtest/gtest.h>

#include "support/families.hpp"

namespace eigentrail::test::pair_curvature_test {
namespace {

constexpr Eigen::Index n = 9;
constexpr double scale = 0.4;

class CurvatureOfAPair : public testing::TestWithParam<int> {
 protected:
  CurvatureOfAPair() {
    if (k == 1) W.bottomRows(n).setZero();  // as that of a single mode
  }

  ComplexVector random_change() { return random_complex(n * k + k * k, 1, engine); }
  PairCurvature entry(Eigen::Index i, Eigen::Index j) const { return {place, W1, scale, i, j}; }

  /// J at U + sign V, times x.
  ComplexVector jacobian_times(const ComplexVector& V, double sign, const ComplexVector& x) const {
    const ComplexMatrix moved_Z = Z + sign * V.head(n * k).reshaped(n, k);
    const ComplexMatrix moved_Lambda = Lambda + sign * scale * V.tail(k * k).reshaped(k, k);
    return jacobian_matrix({pencil, moved_Z, moved_Lambda}, W, scale) * x;
  }

  /// The sum of A(E_ij) x with the entries of the Lambda part of another change.
  ComplexVector with_eigenvalues_of(const ComplexVector& other, const ComplexVector& x) const {
    ComplexVector sum = ComplexVector::Zero(x.size());
    for (Eigen::Index j = 0; j < k; ++j)
      for (Eigen::Index i = 0; i < k; ++i) sum += other[n * k + i + j * k] * entry(i, j).times(x);
    return sum;
  }

  Eigen::Index k = GetParam();
  std::mt19937_64 engine{21};
  ReducedPencil family = at(random_family(n, 4), 0.1);
  PencilAtPoint pencil{family};
  ComplexMatrix Z = random_complex(n, k, engine);
  ComplexMatrix Lambda = random_complex(k, k, engine);
  ComplexMatrix W = random_complex(2 * n, k, engine);
  ComplexMatrix W1 = k == 1 ? ComplexMatrix(ComplexMatrix::Zero(n, 1)) : ComplexMatrix(W.bottomRows(n));
  PairAtPlace place{pencil, Z, Lambda};
};

TEST_P(CurvatureOfAPair, IsTheSecondDerivative) {
  const ComplexVector u = random_change(), v = random_change();
  const ComplexVector expected = 0.5 * (jacobian_times(v, 1.0, u) - jacobian_times(v, -1.0, u));
  const ComplexVector found = with_eigenvalues_of(v, u) + with_eigenvalues_of(u, v);
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(CurvatureOfAPair, HasAdjoints) {
  const ComplexVector u = random_change(), v = random_change();
  for (Eigen::Index j = 0; j < k; ++j) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const Complex expected = u.dot(entry(i, j).times(v));
      EXPECT_LT(std::abs(entry(i, j).adjoint_times(u).dot(v) - expected), 1e-12 * u.norm() * v.norm());
      EXPECT_GT(std::abs(expected), 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, CurvatureOfAPair, testing::Values(1, 2, 3));

}  // namespace
}  // namespace eigentrail::test::pair_curvature_test
