// The Jacobian of the equations of an invariant pair, its change from one place of a step to another, and
// the second derivative of the equations.
#pragma once

#include <vector>

#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

/// `scale` of the unknowns (vec Z, vec Lambda / scale), from the distance `gap` to the nearest other
/// eigenvalue and the size of Lambda: half the distance, so that changes of Z and of Lambda by one are about
/// equally large relative to what separates the pair from others. This holds for an eigenvalue that passes
/// through zero, too. It affects the strength of the bounds of the certificate, not their validity.
double unknown_scale(double gap, double size);

/// A pair (Z, Lambda), in general not an exact solution, and the pencil at its place.
struct PairAtPlace {
  /// Keeps references to its arguments.
  PairAtPlace(const PencilAtPoint& pencil, const ComplexMatrix& Z, const ComplexMatrix& Lambda);

  /// M Z Lambda^2 + C Z Lambda + K Z.
  ComplexMatrix residual() const;

  const PencilAtPoint& pencil;
  const ComplexMatrix& Z;       ///< n x k
  const ComplexMatrix& Lambda;  ///< k x k
  ComplexMatrix MZ;             ///< M Z
  ComplexMatrix slope;          ///< M Z Lambda + C Z
};

/// The Jacobian J of the pair's equations and of its normalization, as a matrix of size n k + k^2 that maps
/// (vec Z, vec Lambda / scale). W = [W0; W1] is 2n x k.
ComplexMatrix jacobian_matrix(const PairAtPlace& at, const ComplexMatrix& W, double scale);

/// J(to) - J(from) as a linear map of (vec Z, vec Lambda / scale), n k + k^2 entries. Keeps references to its
/// arguments. Stored as a sum of products, because the matrix of a block would have k^2 times the entries of
/// the pencil. Where the pencil is banded this is no hindrance.
class JacobianChange {
 public:
  /// W1 (n x k) is the lower half of the normalization W.
  JacobianChange(const PairAtPlace& from, const PairAtPlace& to, const ComplexMatrix& W1, double scale);

  /// Of all columns of V together, which takes less time.
  ComplexMatrix times(const ComplexMatrix& V) const;
  ComplexMatrix adjoint_times(const ComplexMatrix& V) const;

 private:
  void set_terms();
  void set_bands();
  /// For all blocks X of k columns, side by side: the change of M X Lambda^2 + C X Lambda + K X, and the
  /// adjoint of this map.
  ComplexMatrix pencil_times(const ComplexMatrix& X) const;
  ComplexMatrix pencil_adjoint_times(const ComplexMatrix& R) const;

  const PairAtPlace &from_, &to_;
  const ComplexMatrix& W1_;
  double scale_;
  ComplexMatrix Z_, Lambda_, slope_;  ///< changes of Z, of Lambda and of M Z Lambda + C Z
  /// The change is X -> sum of B_i X L_i. The B_i are stacked in one matrix, because one product takes less
  /// time than several small ones.
  Matrix B_;
  std::vector<ComplexMatrix> L_;
  /// In band storage: the change of X -> column i of the residual by column j of X, as entry i + k j.
  std::vector<ComplexMatrix> bands_;
};

/// The part of F'' that belongs to one entry of a change L' of Lambda, as a linear map of (vec X, vec L /
/// scale), where X is a change of Z and L one of Lambda. F'' of two changes is
///
///     F''[(X, L), (X', L')] = A(L') (X, L) + A(L) (X', L'),
///     A(L') (X, L) = (M X (L' Lambda + Lambda L') + C X L' + M Z (L L' + L' L) / 2,  W1^H X L')
///
/// and |B F''| <= 2 |Lambda part| (sum over the entries (i, j) of |B A(E_ij)|^2)^(1/2), with the matrices
/// E_ij of one entry `scale`, and the bound of the Lambda part of a change in the norm of the unknowns.
class PairCurvature {
 public:
  /// A(E_ij). Keeps references to its arguments. W1 (n x k) is the lower half of the normalization.
  PairCurvature(const PairAtPlace& at, const ComplexMatrix& W1, double scale, Eigen::Index i, Eigen::Index j);

  ComplexVector times(const ComplexVector& v) const;
  ComplexVector adjoint_times(const ComplexVector& v) const;

 private:
  const PairAtPlace& at_;
  const ComplexMatrix& W1_;
  double scale_;
  ComplexMatrix E_;   ///< k x k, with the entry `scale`
  ComplexMatrix EL_;  ///< E Lambda + Lambda E
};

}  // namespace eigentrail
