// Norms of an operator B A, estimated by power iteration. B has `apply` and `apply_adjoint`, which overwrite
// vectors or the columns of a matrix; A has `times` and `adjoint_times`.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
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

/// The largest norm of a column of B V; infinite if one is not a number.
template <class Inverse>
double largest_of_solved(const Inverse& B, ComplexMatrix V, const BallNorm& norm) {
  B.apply(V);
  double largest = 0.0;
  for (Eigen::Index j = 0; j < V.cols(); ++j) {
    ComplexVector v = V.col(j);
    norm.apply_inverse(v);
    const double size = v.norm();
    if (!std::isfinite(size)) return INFINITY;
    largest = std::max(largest, size);
  }
  return largest;
}

/// |B A| from below, by power iteration from the direction v, which is overwritten with the last one. Stops
/// when the estimate exceeds `enough`. Infinite if it is not a number.
template <class Inverse, class Operator>
double norm_of_solved(const Inverse& B, const Operator& A, int iterations, const BallNorm& norm,
                      ComplexVector& v, double enough = INFINITY) {
  double size = 0.0;
  for (int i = 0; i < iterations && !(size > enough); ++i) {
    v.normalize();
    norm.apply(v);
    ComplexVector w = A.times(v);
    B.apply(w);
    norm.apply_inverse(w);
    size = std::max(size, w.norm());
    norm.apply_inverse_adjoint(w);
    B.apply_adjoint(w);
    ComplexVector next = A.adjoint_times(w);
    norm.apply_adjoint(next);
    const double length = next.norm();
    if (!(length > 0.0)) return length == 0.0 ? size : INFINITY;
    size = std::max(size, std::sqrt(length));
    v = std::move(next);
  }
  return size;
}

/// The norm in which B A is small, if that is possible by scaling `directions` of the energy norm. The first
/// direction is about the one that is magnified most.
template <class Inverse, class Operator>
AdaptedNorm adapted_norm(const Inverse& B, const Operator& A, const BallNorm& energy,
                         const ComplexVector& first, Eigen::Index directions) {
  const auto times = [&](ComplexMatrix X) {
    energy.from_energy(X);
    ComplexMatrix Y = A.times(X);
    B.apply(Y);
    energy.to_energy(Y);
    return Y;
  };
  const auto adjoint_times = [&](ComplexMatrix X) {
    energy.to_energy_adjoint(X);
    B.apply_adjoint(X);
    ComplexMatrix Y = A.adjoint_times(X);
    energy.from_energy_adjoint(Y);
    return Y;
  };
  ComplexMatrix Q(first.size(), std::min(directions, first.size()));
  for (Eigen::Index j = 0; j < Q.cols(); ++j)
    Q.col(j) = j == 0 ? first : start_vector(Q.rows(), static_cast<double>(j));
  // One pass of the subspace iteration.
  Q = times(std::move(Q));
  if (!Q.allFinite()) return {};
  Q = orthonormal(Q);
  ComplexMatrix adjoint = adjoint_times(Q);
  if (!adjoint.allFinite()) return {};
  // The left singular vectors.
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(adjoint.adjoint() * adjoint));
  Q = Q * squares.eigenvectors();
  adjoint = adjoint * squares.eigenvectors();
  const ComplexMatrix TQ = times(Q);
  return TQ.allFinite() ? AdaptedNorm::balancing(std::move(Q), TQ, adjoint) : AdaptedNorm();
}

}  // namespace eigentrail
