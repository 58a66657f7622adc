#include "continuation/step/inverse_distance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// As in certificate.cpp: power iterations of a norm estimate, and the factor on it.
constexpr int distance_iterations = 4;
constexpr double distance_safety = 1.2;
/// In place of infinity, so that products with zero are numbers.
constexpr double beyond_all = 1e100;

/// Replaces X by the solution Y of A Y - Y B = X, column by column.
void solve(const ComplexMatrix& A, const ComplexMatrix& B, ComplexMatrix& X) {
  const Eigen::Index m = A.rows();
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    if (j > 0) X.col(j) += X.leftCols(j).lazyProduct(B.col(j).head(j));
    for (Eigen::Index i = m; i-- > 0;) {
      X(i, j) /= A(i, i) - B(j, j);
      X.col(j).head(i) -= X(i, j) * A.col(i).head(i);
    }
  }
}

/// The same for the adjoint equation A^H Y - Y B^H = X.
void solve_adjoint(const ComplexMatrix& A, const ComplexMatrix& B, ComplexMatrix& X) {
  const Eigen::Index m = A.rows();
  const Eigen::Index k = B.rows();
  for (Eigen::Index j = k; j-- > 0;) {
    const Eigen::Index behind = k - 1 - j;
    if (behind > 0) X.col(j) += X.rightCols(behind).lazyProduct(B.row(j).tail(behind).adjoint());
    for (Eigen::Index i = 0; i < m; ++i) {
      X(i, j) -= A.col(i).head(i).dot(X.col(j).head(i));
      X(i, j) /= std::conj(A(i, i) - B(j, j));
    }
  }
}

}  // namespace

ComplexMatrix triangular_form(const ComplexMatrix& Lambda) {
  if (Lambda.rows() == 1) return Lambda;
  return Eigen::ComplexSchur<ComplexMatrix>(Lambda, false).matrixT();
}

double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B) {
  if (A.size() == 1 && B.size() == 1) return std::min(1.0 / std::abs(A(0, 0) - B(0, 0)), beyond_all);
  // A vector without symmetry, so that it is not orthogonal to the wanted one.
  ComplexMatrix X(A.rows(), B.rows());
  for (Eigen::Index i = 0; i < X.size(); ++i) X(i) = {1.0, std::sin(1.0 + 2.3 * static_cast<double>(i))};
  double norm = 0.0;
  for (int i = 0; i < distance_iterations; ++i) {
    X.normalize();
    solve(A, B, X);
    const double forward = X.norm();
    if (!(forward < beyond_all)) return beyond_all;
    X /= forward;
    solve_adjoint(A, B, X);
    norm = std::max({norm, forward, X.norm()});
    if (!(norm < beyond_all)) return beyond_all;
  }
  return distance_safety * norm;
}

}  // namespace eigentrail
