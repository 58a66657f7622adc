// Rank-revealing factorization of a constraint Jacobian A (m x n): A^T = [Q1 Q2] [R1; 0] (seed paper, Eq.
// 48).
//
// The rows of A are scaled to unit length first, so that the rank does not depend on the units of the
// constraints. The complete orthogonal decomposition serves redundant rows: A+ b is then the minimum-norm
// least-squares solution; multipliers are measured by the scaled rows.
//
// A sparse A whose rows are safely independent is factored by its normal equations instead
// (core/sparse_constraints.hpp), in time about proportional to its entries.
#pragma once

#include <Eigen/QR>
#include <memory>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class SparseConstraints;

class ConstraintFactorization {
 public:
  /// Pivots below this fraction of the largest count as zero. Two rods at an angle of 1e-10 stay two
  /// constraints; a rod written twice is one.
  static constexpr double rank_tolerance = 1e-13;

  ConstraintFactorization() = default;

  /// Factors A; cost O(n m^2) when it is dense, or sparse with rows that are nearly dependent. m = 0 is
  /// allowed.
  explicit ConstraintFactorization(const SystemMatrix& A);

  /// Whether the sparse factorization serves A.
  bool is_sparse() const { return sparse_ != nullptr; }

  Eigen::Index rank() const { return rank_; }

  /// Smallest pivot over the largest, of the independent rows at unit length: about the least angle between
  /// constraints. Rounding of c moves positions by its reciprocal. 1 without constraints.
  double independence() const { return independence_; }

  /// Orthonormal basis Q2 of the null space of A, n x (n - rank). Of a sparse factorization it is computed
  /// when it is first asked for, in O(n m^2).
  const Matrix& null_basis() const;

  /// (I - A+ A) X: the part of every column that the constraints allow, X n x k.
  Matrix allowed_part(const Matrix& X) const;

  /// A+ B: minimum-norm X with A X = B, B m x k.
  Matrix pseudo_inverse_times(const Matrix& B) const;

  /// (A^T)+ b: minimum-norm lambda with A^T lambda = b in the least-squares sense (Eq. 15), b of size n.
  Vector transposed_pseudo_inverse_times(const Vector& b) const;

 private:
  void factor_dense(const Matrix& A);

  Eigen::Index rank_ = 0;
  double independence_ = 1.0;
  Vector row_scale_;  ///< 1 / row norm of A
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition_;
  Matrix null_basis_;
  std::shared_ptr<const SparseConstraints> sparse_;  ///< in place of all of these but rank and independence
};

}  // namespace eigentrail
