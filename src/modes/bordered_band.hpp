// LU factors of a banded matrix with a border.
#pragma once

#include <algorithm>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Solutions with [P, X; Y, D], where P is banded, n x n, and the columns X (n x k), the rows Y (k x n) and D
/// (k x k) are full.
///
/// An elimination with partial pivoting that took a row of Y as a pivot would fill the factors. So k
/// components of the solution are first set to zero, those in which the null vectors of P are largest. This
/// leaves A = [P without k columns, X], n x n and banded but for its last columns. The null vectors V of [P
/// X] whose chosen components are the unit matrix then satisfy the last rows:
///
///     x = y + V ([Y D] V)^-1 (b_2 - [Y D] y),     y = A^-1 b_1
///
/// If the matrix is singular, solutions are not finite; nothing is thrown.
class BorderedBand {
 public:
  /// `band`: P in band storage, (2 width + 1) x n. `Z` (n x k): about the vectors for which P is singular.
  /// Cost: 2 n width^2 multiplications, and 6 n width for every solution.
  BorderedBand(const ComplexMatrix& band, const ComplexMatrix& Z, const ComplexMatrix& X,
               const ComplexMatrix& Y, const ComplexMatrix& D);

  /// Whether the solutions are as accurate as those with factors of the whole matrix, to two digits. They are
  /// not where the null vectors of [P X] are small in all components that Z leaves to choose: two eigenvalues
  /// may have one vector.
  bool is_accurate() const;

  /// Overwrites the columns of B, of n + k rows, with the solutions, or with those of the adjoint equations.
  void solve_in_place(Eigen::Ref<ComplexMatrix> B) const;
  void solve_adjoint_in_place(Eigen::Ref<ComplexMatrix> B) const;

 private:
  void choose_columns(const ComplexMatrix& Z);
  void factor(const ComplexMatrix& band);
  /// Overwrite b (n) with A^-1 b and A^-H b.
  void solve_within(ComplexVector& b) const;
  void solve_adjoint_within(ComplexVector& b) const;
  /// b -> L^-1 b, with the exchanges of rows, and its adjoint.
  void eliminate(ComplexVector& b) const;
  void eliminate_adjoint(ComplexVector& b) const;
  /// Overwrites the leading n - k entries of b with U^-1 b (form 'N') or U^-H b (form 'C').
  void substitute(char form, ComplexVector& b) const;
  /// The multipliers of column j of L, which are below the diagonal in as many rows as `reach` tells.
  auto multipliers(Eigen::Index j) const { return factors_.col(j).segment(upper_ + 1, reach(j)); }
  Eigen::Index reach(Eigen::Index j) const { return std::min(lower_, n_ - 1 - j); }

  Eigen::Index n_;
  Eigen::Index lower_, upper_;               ///< widths of L and of U
  std::vector<Eigen::Index> kept_, chosen_;  ///< n and k of the n + k unknowns, ascending
  ComplexMatrix factors_;                    ///< of the leading n - k columns: the diagonal is row `upper_`
  std::vector<int> pivots_;
  ComplexMatrix last_;          ///< the last k columns of U, n - k rows, that is X after the elimination
  ComplexMatrix last_inverse_;  ///< inverse of what is left of X in the last k rows
  ComplexMatrix rows_;          ///< [Y D] on the unknowns that are kept, k x n
  ComplexMatrix null_;          ///< V there, n x k
  ComplexMatrix inverse_;       ///< ([Y D] V)^-1
};

}  // namespace eigentrail
