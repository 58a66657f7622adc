#include "projection/projection_space.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/orthonormal.hpp"
#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Parts of unit vectors that are smaller are left out: the error of an eigenvalue is their square times the
/// ratio of the largest to the followed eigenvalues of a finite-element model, about 1e9.
constexpr double negligible = 1e-10;

/// Removes from the columns of B their components in the space of Q; twice, because one pass leaves rounding.
void orthogonalize(const Matrix& Q, Matrix& B) {
  for (int pass = 0; pass < 2 && Q.cols() > 0; ++pass) B -= product(Q, transposed_product(Q, B));
}

/// An orthonormal basis of the columns of B, without those that are negligible beside the ones before.
Matrix independent_basis(Matrix B) {
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    Vector column = B.col(j);
    for (int pass = 0; pass < 2; ++pass)
      column -= B.leftCols(count) * (B.leftCols(count).transpose() * column);
    const double norm = column.norm();
    if (norm > negligible) B.col(count++) = column / norm;
  }
  return B.leftCols(count);
}

}  // namespace

void ProjectionSpace::add(const ComplexMatrix& vectors, Side side) {
  const Eigen::Index k = vectors.cols();
  Matrix added(vectors.rows(), 2 * k);
  added << vectors.real(), vectors.imag();
  Matrix fresh = added;
  // What is left of a vector that nearly lies in the space is known to few digits until it is long again.
  for (int pass = 0; pass < 2; ++pass) {
    orthogonalize(basis_, fresh);
    fresh = independent_basis(std::move(fresh));
  }
  const Eigen::Index before = basis_.cols(), count = fresh.cols();
  basis_.conservativeResize(Eigen::NoChange, before + count);
  basis_.rightCols(count) = fresh;
  Matrix all = Matrix::Zero(before + count, vectors_.cols() + 2 * k);
  all.topLeftCorner(before, vectors_.cols()) = vectors_;
  all.rightCols(2 * k) = transposed_product(basis_, added);
  vectors_ = std::move(all);
  sides_.insert(sides_.end(), static_cast<std::size_t>(2 * k), side);
}

void ProjectionSpace::reduce(const Matrix& energy, double accuracy) {
  const Components all = components(energy, Side::both);
  const Eigen::Index rank = all.needed(accuracy);
  const Matrix parts = orthonormal(Matrix(all.parts.leftCols(rank)));
  basis_ = product(basis_, parts);
  vectors_ = transposed_product(parts, vectors_);
}

ProjectionSpace::Components ProjectionSpace::components(const Matrix& energy, Side side) const {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(energy);
  const Vector& squares = solver.eigenvalues();
  const double floor = std::numeric_limits<double>::epsilon() * squares.cwiseAbs().maxCoeff();
  const Vector weights = squares.cwiseAbs().cwiseMax(floor).cwiseSqrt();
  Matrix weighted = weights.asDiagonal() * (solver.eigenvectors().transpose() * vectors_);
  for (Eigen::Index j = 0; j < weighted.cols(); ++j) {
    const Side of_this = sides_[static_cast<std::size_t>(j)];
    const bool counts = side == Side::both || of_this == Side::both || of_this == side;
    const double norm = counts ? weighted.col(j).norm() : INFINITY;
    if (norm > 0.0) weighted.col(j) /= norm;
  }
  const SingularVectors<Matrix> found = right_singular_vectors(Matrix(weighted.transpose()));
  if (!found.values.allFinite())
    return {Matrix::Identity(energy.rows(), energy.cols()), Vector::Ones(energy.rows())};
  return {solver.eigenvectors() * (weights.cwiseInverse().asDiagonal() * found.V), found.values};
}

namespace {

/// Least cosine of the angle between principal vectors of both spaces. With 0.02, eigenvalues of the
/// projection that stand for none of the large pencil come near to the followed ones; with 0.3 it has a tenth
/// more coordinates.
constexpr double least_cosine = 0.1;

/// Vectors with x_i^T E x_j = 0 for i != j, else +-1, in the space of the columns of B.
Matrix normalized(const Matrix& B, const Matrix& energy) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(congruence(B, energy, B));
  const Vector sizes = solver.eigenvalues().cwiseAbs();
  const double floor = std::numeric_limits<double>::epsilon() * sizes.maxCoeff();
  return product(
      B, Matrix(solver.eigenvectors() * sizes.cwiseMax(floor).cwiseSqrt().cwiseInverse().asDiagonal()));
}

Matrix joined(const Matrix& A, const Matrix& B) {
  Matrix both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

}  // namespace

TwoSpaces two_spaces(const ProjectionSpace& both, const Matrix& energy, double accuracy) {
  const Matrix E = 0.5 * (energy + energy.transpose());
  const auto of_right = both.components(E, Side::right), of_left = both.components(E, Side::left);
  const Eigen::Index count = std::max(of_right.needed(accuracy), of_left.needed(accuracy));
  Matrix V = normalized(of_right.parts.leftCols(count), E), W = normalized(of_left.parts.leftCols(count), E);
  const SingularVectors<Matrix> angles = singular_vectors(congruence(W, E, V));
  const Eigen::Index few = (angles.values.array() < least_cosine).count();
  const Matrix v = product(V, Matrix(angles.V.rightCols(few)));
  const Matrix w = product(W, Matrix(angles.U.rightCols(few)));
  V = orthonormal(joined(V, w));
  W = orthonormal(joined(W, v));
  // The polar factor of W^T E V turns the left basis to the right one.
  const SingularVectors<Matrix> turn = singular_vectors(congruence(W, E, V));
  return {std::move(V), product(W, product(turn.U, Matrix(turn.V.transpose())))};
}

}  // namespace eigentrail
