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

  /// Overwrites B (size x columns) with A^-1 B. Cost size^2 per column.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const { solve('N', B); }
  void solve_in_place(ComplexVector& b) const { solve('N', b); }

  /// Overwrites B with A^-H B.
  void solve_adjoint_in_place(ComplexVector& b) const { solve('C', b); }

 private:
  void solve(char form, Eigen::Ref<ComplexMatrix> B) const;

  ComplexMatrix factors_;
  std::vector<int> pivots_;
};

}  // namespace eigentrail
