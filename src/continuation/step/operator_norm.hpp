// Norms of an operator B A. B has `apply` and `apply_adjoint`, which overwrite vectors or the columns of a
// matrix; A has `times` and `adjoint_times`.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "continuation/step/ball_norm.hpp"
#include "core/orthonormal.hpp"

namespace eigentrail {

/// Start of a power iteration: a vector without symmetry, so that it is not orthogonal to the wanted one.
inline ComplexVector start_vector(Eigen::Index size, double number = 0.0) {
  ComplexVector v(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto place = static_cast<double>(i);
    v[i] = {std::cos(1.7 * number * place), std::sin(1.0 + (2.3 + number) * place)};
  }
  return v;
}

/// T = S^-1 B A S and its adjoint, with the S of a norm: in the coordinates in which that norm is the plain
/// one, the operator B A. Keeps references to all three.
template <class Inverse, class Operator>
class OperatorInNorm {
 public:
  OperatorInNorm(const Inverse& B, const Operator& A, const BallNorm& norm) : B_(B), A_(A), norm_(norm) {}

  /// T X and T^H X, for a vector or the columns of a matrix.
  template <class Columns>
  Columns times(Columns X) const {
    norm_.apply(X);
    Columns Y = A_.times(X);
    B_.apply(Y);
    norm_.apply_inverse(Y);
    return Y;
  }
  template <class Columns>
  Columns adjoint_times(Columns Y) const {
    norm_.apply_inverse_adjoint(Y);
    B_.apply_adjoint(Y);
    Columns X = A_.adjoint_times(Y);
    norm_.apply_adjoint(X);
    return X;
  }

 private:
  const Inverse& B_;
  const Operator& A_;
  const BallNorm& norm_;
};

/// |T| from below, by power iteration from the direction v, which is overwritten with the last one. Stops
/// when the estimate exceeds `enough`. Infinite if it is not a number.
template <class Operator>
double estimated_norm(const Operator& T, int iterations, ComplexVector& v, double enough = INFINITY) {
  double size = 0.0;
  for (int i = 0; i < iterations && !(size > enough); ++i) {
    v.normalize();
    const ComplexVector w = T.times(v);
    size = std::max(size, w.norm());
    ComplexVector next = T.adjoint_times(w);
    const double length = next.norm();
    if (!(length > 0.0)) return length == 0.0 ? size : INFINITY;
    size = std::max(size, std::sqrt(length));
    v = std::move(next);
  }
  return size;
}

/// The norm in which T is small, if that is possible by scaling that many directions. The first direction is
/// about the one that is magnified most.
template <class Operator>
AdaptedNorm adapted_norm(const Operator& T, const ComplexVector& first, Eigen::Index directions) {
  ComplexMatrix Q(first.size(), std::min(directions, first.size()));
  for (Eigen::Index j = 0; j < Q.cols(); ++j)
    Q.col(j) = j == 0 ? first : start_vector(Q.rows(), static_cast<double>(j));
  // One pass of the subspace iteration.
  Q = T.times(std::move(Q));
  if (!Q.allFinite()) return {};
  Q = orthonormal(Q);
  ComplexMatrix adjoint = T.adjoint_times(Q);
  if (!adjoint.allFinite()) return {};
  // The left singular vectors.
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(adjoint.adjoint() * adjoint));
  Q = Q * squares.eigenvectors();
  adjoint = adjoint * squares.eigenvectors();
  const ComplexMatrix TQ = T.times(Q);
  return TQ.allFinite() ? AdaptedNorm::balancing(std::move(Q), TQ, adjoint) : AdaptedNorm();
}

}  // namespace eigentrail
