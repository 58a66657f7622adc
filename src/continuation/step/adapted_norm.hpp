// A norm in which an operator that is far from normal is about as large as its eigenvalues.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Scales d such that the rows and columns of D^-1 A D are about equally large beside the diagonal (Osborne,
/// Journal of the ACM 7, 1960), from the squares of the entries of A (n x n). Rows and columns without
/// entries keep the scale one. Cost n^2 per sweep.
Vector balancing_scales(Matrix squares, int sweeps);

/// The norm |S^-1 x|, where S = I + Q (D - I) Q^H with orthonormal columns Q and a positive diagonal D. Where
/// an operator T is large on few directions only, as for the bearings of a rotor, and its range there is
/// mapped to little, the norm of S^-1 T S is far below that of T. S is Hermitian.
class AdaptedNorm {
 public:
  /// The plain norm.
  AdaptedNorm() = default;

  /// The norm that balances T (balancing_scales) as a matrix of norms: one row and column
  /// for every column of Q (n x r, orthonormal), and one for all that is orthogonal to them. The columns of Q
  /// should be the left singular vectors of T with the largest singular values. `TQ`: T Q. `adjoint`: T^H Q.
  static AdaptedNorm balancing(ComplexMatrix Q, const ComplexMatrix& TQ, const ComplexMatrix& adjoint);

  /// Overwrites a vector, or the columns of a matrix, with S X; S^-1 X.
  template <class Columns>
  void apply(Columns& X) const {
    scale(X, factors_);
  }
  template <class Columns>
  void apply_inverse(Columns& X) const {
    scale(X, factors_.cwiseInverse());
  }

  bool is_plain() const { return factors_.size() == 0; }

 private:
  template <class Columns>
  void scale(Columns& X, const Vector& factors) const {
    if (is_plain()) return;
    const Columns parts = Q_.adjoint() * X;
    X += Q_ * ((factors.array() - 1.0).matrix().cast<Complex>().asDiagonal() * parts);
  }

  ComplexMatrix Q_;
  Vector factors_;  ///< the diagonal of D
};

}  // namespace eigentrail
