// LU factors of a square complex matrix with partial pivoting, by LAPACK.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A singular matrix gives solutions that are not finite; nothing is thrown.
class ComplexLu {
 public:
  /// Factors A (size x size), which is overwritten. Cost size^3 / 3 multiplications.
  explicit ComplexLu(ComplexMatrix A);

  Eigen::Index size() const { return factors_.rows(); }

  /// Overwrites b with A^-1 b. Cost size^2; without the copies of the factors that LAPACK makes: at size 200
  /// in a quarter of the time.
  void solve_in_place(ComplexVector& b) const;

  /// Overwrites b with A^-H b.
  void solve_adjoint_in_place(ComplexVector& b) const;

 private:
  /// Overwrites b with L^-1 b, L^-H b ('L'; 'N', 'C') or with U^-1 b, U^-H b.
  void substitute(char triangle, char form, ComplexVector& b) const;

  ComplexMatrix factors_;
  std::vector<int> pivots_;
};

}  // namespace eigentrail
