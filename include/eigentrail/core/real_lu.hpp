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

  /// Overwrites b with A^-1 b; the real and imaginary parts are two right sides of one call. Cost 2 size^2.
  void solve_in_place(ComplexVector& b) const { solve('N', b); }

  /// Overwrites b with A^-T b.
  void solve_adjoint_in_place(ComplexVector& b) const { solve('T', b); }

 private:
  void solve(char form, ComplexVector& b) const;

  Matrix factors_;
  std::vector<int> pivots_;
};

}  // namespace eigentrail
