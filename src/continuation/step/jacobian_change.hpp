// The linearized equations of an invariant pair at one place of a step less those at another.
#pragma once

#include <vector>

#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

/// A pair, not necessarily an exact one, and the pencil at its place.
struct PairAtPlace {
  const PencilAtPoint& pencil;
  const ComplexMatrix& Z;       ///< n x k
  const ComplexMatrix& Lambda;  ///< k x k
};

/// J, the linear map of (vec Z, vec Lambda / scale), n k + k^2 entries, as a matrix; W = [W0; W1] is 2n x k.
ComplexMatrix jacobian_matrix(const PairAtPlace& at, const ComplexMatrix& W, double scale);

/// J(to) - J(from), a linear map of (vec Z, vec Lambda / scale), n k + k^2 entries. Refers to all it is
/// given. That of a single mode is held as a matrix, that of a block as a sum of products: as a matrix it
/// would have k^2 times the pencil's entries.
class JacobianChange {
 public:
  /// W1 (n x k) are the lower rows of the normalization.
  JacobianChange(const PairAtPlace& from, const PairAtPlace& to, const ComplexMatrix& W1, double scale);

  ComplexVector times(const ComplexVector& v) const;
  ComplexVector adjoint_times(const ComplexVector& v) const;

 private:
  void set_pencil();
  void set_terms();

  PairAtPlace from_, to_;
  const ComplexMatrix& W1_;
  double scale_;
  ComplexMatrix MZ_from_, MZ_to_;
  ComplexMatrix Z_, Lambda_, slope_;  ///< changes of Z, of Lambda and of M Z Lambda + C Z
  ComplexMatrix P_;                   ///< of a single mode: the pencil's change
  /// Of a block, X -> the sum of B_i X L_i: all B_i one below the other, for one product takes less time than
  /// several small ones; and the L_i.
  Matrix B_;
  std::vector<ComplexMatrix> L_;
};

}  // namespace eigentrail
