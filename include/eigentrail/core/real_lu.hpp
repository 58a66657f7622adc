// LU factors of a square real matrix with partial pivoting, by LAPACK.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// If A is singular, solutions are not finite; nothing is thrown.
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
