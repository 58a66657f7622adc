// Sparse constraint Jacobian A (m x n) of full row rank, by its normal equations:
//
//     S = D A,  S S^T = P^T L E L^T P,    A+ = S^T (S S^T)^-1 D,    (A^T)+ = D (S S^T)^-1 S
//
// with D scaling the rows to unit length. Pivot i, an entry of E, is the squared distance of row i to the
// span of those before it. The normal equations square the condition; where a pivot is small they are not
// used, and one refinement makes up for the rest.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <mutex>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class SparseConstraints {
 public:
  /// A row closer to the others than this leaves A to the rank-revealing factorization: the normal equations
  /// then lose six of sixteen digits, which the refinement brings back.
  static constexpr double least_independence = 1e-3;

  /// Factors A; null where its rows are not safely independent.
  static std::shared_ptr<const SparseConstraints> factor(const SparseMatrix& A);

  /// As of ConstraintFactorization.
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
  mutable Matrix null_basis_;  ///< empty until it is asked for
};

}  // namespace eigentrail
