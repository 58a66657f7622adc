// The second derivative of the equations of an invariant pair.
#pragma once

#include "continuation/step/jacobian_change.hpp"

namespace eigentrail {

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
