#include "continuation/step/inverse_distance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "eigentrail/modes/all_pairs.hpp"

namespace eigentrail {
namespace {

/// In place of infinity, so that products with zero are numbers.
constexpr double beyond_all = 1e100;

}  // namespace

double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B) {
  if (A.size() == 1 && B.size() == 1) return std::min(1.0 / std::abs(A(0) - B(0)), beyond_all);
  const ComplexMatrix inverse = inverse_sylvester(A, B);
  if (!(inverse.norm() < beyond_all)) return beyond_all;
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(inverse.adjoint() * inverse),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues().maxCoeff());
}

}  // namespace eigentrail
