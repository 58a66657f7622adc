// Factorization of a sparse constraint Jacobian A (m x n) of full row rank by its normal equations:
//
//     S = D A,  S S^T = P^T L E L^T P,    A+ = S^T (S S^T)^-1 D,    (A^T)+ = D (S S^T)^-1 S
//
// D scales the rows to unit length, P is a fill-reducing permutation. Pivot i, an entry of the diagonal E, is
// the squared distance of row i from the span of the rows before it. The normal equations square the
// condition number: they are not used if a pivot is small, and one step of iterative refinement restores the
// digits that they lose otherwise.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <mutex>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class SparseConstraints {
 public:
  /// Smallest distance of a unit row from the span of the rows before it, relative to the largest. Below it A
  /// is left to the rank-revealing factorization. At this limit the normal equations lose six of sixteen
  /// digits, which the refinement restores.
  static constexpr double least_independence = 1e-3;

  /// Factors A. Null if A has zero rows, more rows than columns, or rows that are not clearly independent.
  static std::shared_ptr<const SparseConstraints> factor(const SparseMatrix& A);

  /// As in ConstraintFactorization.
  double independence() const { return independence_; }
  const Matrix& null_basis() const;
  Matrix allowed_part(const Matrix& X) const;
  Matrix pseudo_inverse_times(const Matrix& B) const;
  Vector transposed_pseudo_inverse_times(const Vector& b) const;

 private:
  SparseConstraints() = default;

  Matrix scaled_pseudo_inverse_times(const Matrix& B) const;  ///< S+ B

  SparseMatrix S_, S_transposed_;
  Vector row_scale_;
  double independence_ = 1.0;
  Eigen::SimplicialLDLT<SparseMatrix> normal_;
  mutable std::once_flag asked_;
  mutable Matrix null_basis_;  ///< empty until null_basis() is called
};

}  // namespace eigentrail
