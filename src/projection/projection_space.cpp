#include "projection/projection_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <limits>

#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Parts of unit vectors that are smaller are left out: the error of an eigenvalue is their square times the
/// ratio of the largest to the followed eigenvalues of a finite-element model, about 1e9.
constexpr double negligible = 1e-10;

/// Removes from the columns of B their components in the space of Q; twice, because one pass leaves rounding.
void orthogonalize(const Matrix& Q, Matrix& B) {
  for (int pass = 0; pass < 2 && Q.cols() > 0; ++pass) B -= Q * (Q.transpose() * B);
}

}  // namespace

void ProjectionSpace::add(const ComplexMatrix& vectors) {
  const Eigen::Index k = vectors.cols();
  Matrix B(vectors.rows(), 2 * k);
  B << vectors.real(), vectors.imag();
  const Matrix added = B;
  orthogonalize(basis_, B);
  Matrix fresh(B.rows(), 2 * k);
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < 2 * k; ++j) {
    Matrix column = B.col(j);
    orthogonalize(fresh.leftCols(count), column);
    orthogonalize(basis_, column);
    const double norm = column.norm();
    if (!(norm > negligible)) continue;
    column /= norm;
    orthogonalize(basis_, column);
    orthogonalize(fresh.leftCols(count), column);
    fresh.col(count++) = column.normalized();
  }
  const Eigen::Index before = basis_.cols();
  basis_.conservativeResize(Eigen::NoChange, before + count);
  basis_.rightCols(count) = fresh.leftCols(count);
  Matrix all = Matrix::Zero(before + count, vectors_.cols() + 2 * k);
  all.topLeftCorner(before, vectors_.cols()) = vectors_;
  all.rightCols(2 * k) = basis_.transpose() * added;
  vectors_ = std::move(all);
}

Matrix ProjectionSpace::principal(const Matrix& energy, double accuracy) const {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(energy);
  const Vector& squares = solver.eigenvalues();
  const double floor = std::numeric_limits<double>::epsilon() * squares.cwiseAbs().maxCoeff();
  const Vector weights = squares.cwiseAbs().cwiseMax(floor).cwiseSqrt();
  Matrix weighted = weights.asDiagonal() * (solver.eigenvectors().transpose() * vectors_);
  for (Eigen::Index j = 0; j < weighted.cols(); ++j) {
    const double norm = weighted.col(j).norm();
    if (norm > 0.0) weighted.col(j) /= norm;
  }
  const SingularVectors<Matrix> components = right_singular_vectors(Matrix(weighted.transpose()));
  if (!components.values.allFinite()) return Matrix::Identity(energy.rows(), energy.cols());
  const Eigen::Index rank = (components.values.array() > accuracy).count();
  const Matrix parts =
      solver.eigenvectors() * (weights.cwiseInverse().asDiagonal() * components.V.leftCols(rank));
  return Eigen::HouseholderQR<Matrix>(parts).householderQ() * Matrix::Identity(parts.rows(), rank);
}

}  // namespace eigentrail
