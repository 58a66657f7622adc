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
  /// X -> B X L.
  struct Term {
    const Matrix* B;
    ComplexMatrix L;
  };

  void set_pencil();
  void add_terms(const Matrix& from, const ComplexMatrix& L_from, const Matrix& to,
                 const ComplexMatrix& L_to);

  PairAtPlace from_, to_;
  const ComplexMatrix& W1_;
  double scale_;
  ComplexMatrix MZ_from_, MZ_to_;
  ComplexMatrix Z_, Lambda_, slope_;  ///< changes of Z, of Lambda and of M Z Lambda + C Z
  ComplexMatrix P_;                   ///< of a single mode: the pencil's change
  Matrix K_;                          ///< of a block: the change of K
  std::vector<Term> terms_;           ///< of a block: those of M and C
};

}  // namespace eigentrail
