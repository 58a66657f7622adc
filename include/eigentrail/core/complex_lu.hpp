// LU factors of a square complex matrix with partial pivoting, by LAPACK.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// If A is singular, solutions are not finite; nothing is thrown.
class ComplexLu {
 public:
  /// Factors A (size x size), which is overwritten. Cost size^3 / 3 multiplications.
  explicit ComplexLu(ComplexMatrix A);

  Eigen::Index size() const { return factors_.rows(); }

  /// Overwrites b with A^-1 b. Cost size^2 multiplications. Calls the triangular solve of BLAS (ztrsv) for a
  /// single right side; at size 200 this takes a quarter of the time of LAPACK's solve, which copies the
  /// factors.
  void solve_in_place(ComplexVector& b) const;

  /// Overwrites b with A^-H b.
  void solve_adjoint_in_place(ComplexVector& b) const;

  /// The same for several right sides, the columns of B. Takes much less time than one by one.
  void solve_in_place(ComplexMatrix& B) const;
  void solve_adjoint_in_place(ComplexMatrix& B) const;

 private:
  /// Overwrites B with L^-1 B or U^-1 B (form 'N'), or with L^-H B or U^-H B (form 'C'); triangle is 'L' or
  /// 'U'.
  template <class Columns>
  void substitute(char triangle, char form, Columns& B) const;

  ComplexMatrix factors_;
  std::vector<int> pivots_;
};

}  // namespace eigentrail
