// LU factors of square matrices, complex or real, with partial pivoting, by LAPACK, for complex right sides.
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

  /// Overwrites the columns of B with A^-1 B. Cost size^2 multiplications for each; several at once take much
  /// less time than one by one. Calls the triangular solve of BLAS (ztrsv) for a single right side; at size
  /// 200 this takes a quarter of the time of LAPACK's solve, which copies the factors.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const;

  /// Overwrites B with A^-H B.
  void solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const;

 private:
  /// Overwrites B with L^-1 B or U^-1 B (form 'N'), or with L^-H B or U^-H B (form 'C'); triangle is 'L' or
  /// 'U'.
  void substitute(char triangle, char form, Eigen::Ref<ComplexMatrix> B) const;

  ComplexMatrix factors_;
  std::vector<int> pivots_;
};

/// The same of a real matrix.
class RealLu {
 public:
  /// Factors A (size x size), which is overwritten. Cost size^3 / 3 real multiplications.
  explicit RealLu(Matrix A);

  Eigen::Index size() const { return factors_.rows(); }

  /// Overwrites the columns of B with A^-1 B; the real and imaginary parts are right sides of one call. Cost
  /// 2 size^2 for each.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const { solve('N', B); }

  /// Overwrites B with A^-T B.
  void solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const { solve('T', B); }

 private:
  void solve(char form, Eigen::Ref<ComplexMatrix> B) const;

  Matrix factors_;
  std::vector<int> pivots_;
};

}  // namespace eigentrail
