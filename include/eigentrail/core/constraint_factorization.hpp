// Rank-revealing factorization of a constraint Jacobian A (m x n): A^T = [Q1 Q2] [R1; 0] (seed paper, Eq.
// 48).
//
// The rows of A are scaled to unit length first, so that the rank does not depend on the units of the
// constraints. A complete orthogonal decomposition handles dependent rows: A+ b is then the minimum-norm
// least-squares solution. The norm of multipliers that is minimized refers to the scaled rows.
//
// A sparse A with clearly independent rows is factored through its normal equations instead
// (core/sparse_constraints.hpp). The cost is then about proportional to the number of nonzeros.
#pragma once

#include <Eigen/QR>
#include <memory>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class SparseConstraints;

class ConstraintFactorization {
 public:
  /// Pivots below this fraction of the largest pivot count as zero. Two rods at an angle of 1e-10 are two
  /// constraints; a rod that is written twice is one.
  static constexpr double rank_tolerance = 1e-13;

  ConstraintFactorization() = default;

  /// Factors A. Cost O(n m^2) for a dense A, and for a sparse A with nearly dependent rows. m = 0 is allowed.
  explicit ConstraintFactorization(const SystemMatrix& A);

  /// Whether A was factored as a sparse matrix.
  bool is_sparse() const { return sparse_ != nullptr; }

  Eigen::Index rank() const { return rank_; }

  /// Smallest over largest pivot of the independent rows, scaled to unit length: about the smallest angle
  /// (rad) between constraints. A rounding error e of the constraint residual moves positions by about e /
  /// independence. 1 if there are no constraints.
  double independence() const { return independence_; }

  /// Orthonormal basis Q2 of the null space of A, n x (n - rank). With a sparse factorization the first call
  /// computes it, at a cost of O(n m^2).
  const Matrix& null_basis() const;

  /// Basis of the combinations nu with nu^T A = 0, m x (m - rank). Only dense factors have any.
  Matrix dependences() const;

  /// (I - A+ A) X: projects the columns of X (n x k) onto the null space of A, that is, onto the motions that
  /// the constraints allow.
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
  /// If set, replaces all of the above except rank_ and independence_.
  std::shared_ptr<const SparseConstraints> sparse_;
};

}  // namespace eigentrail
