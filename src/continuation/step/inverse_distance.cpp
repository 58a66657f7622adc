#include "continuation/step/inverse_distance.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// In place of infinity, so that products with zero are numbers.
constexpr double beyond_all = 1e100;

/// X -> A X - X B as a matrix that maps vec X.
ComplexMatrix sylvester_matrix(const ComplexMatrix& A, const ComplexMatrix& B) {
  const Eigen::Index m = A.rows();
  const Eigen::Index k = B.rows();
  ComplexMatrix matrix = ComplexMatrix::Zero(m * k, m * k);
  for (Eigen::Index j = 0; j < k; ++j) {
    matrix.block(j * m, j * m, m, m) = A;
    for (Eigen::Index i = 0; i < k; ++i) matrix.block(j * m, i * m, m, m).diagonal().array() -= B(i, j);
  }
  return matrix;
}

}  // namespace

double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B) {
  if (A.size() == 1 && B.size() == 1) return std::min(1.0 / std::abs(A(0) - B(0)), beyond_all);
  const ComplexMatrix inverse = sylvester_matrix(A, B).partialPivLu().inverse();
  if (!(inverse.norm() < beyond_all)) return beyond_all;
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(inverse.adjoint() * inverse),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues().maxCoeff());
}

}  // namespace eigentrail
