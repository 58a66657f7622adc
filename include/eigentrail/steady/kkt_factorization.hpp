// The linear system of the steady equations (seed paper, Eq. 38), solved through the null space of A:
//
//     [ K  A^T ] [ dx ]   [ r ]
//     [ A   0  ] [ dl ] = [ g ]        K = -f_/x + (A^T lambda)_/x
//
// dx = A+ g + Q2 w,  (Q2^T K Q2) w = Q2^T (r - K A+ g),  A^T dl = r - K dx. Redundant constraints thus need
// no special treatment; dl is then the solution of minimum norm.
//
// Sparse systems whose constraints are independent and whose Q2^T K Q2 is regular are factored as a whole
// (steady/sparse_kkt.hpp), without Q2.
#pragma once

#include <Eigen/LU>

#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {

class SparseKkt;

class KktFactorization {
 public:
  KktFactorization() = default;

  /// Factors the system; cost O(n m^2 + (n - m)^3) unless the sparse factorization serves. Where Q2^T K Q2 is
  /// singular (a rigid-body freedom), solutions are those of minimum norm.
  KktFactorization(const SystemMatrix& K, const SystemMatrix& A);

  /// Factors the constraints alone, for points whose equilibrium is known; `solve` must not be called.
  explicit KktFactorization(const SystemMatrix& A) : constraints_(A) {}

  bool can_solve() const { return sparse_ != nullptr || K_.size() > 0; }

  /// Solves for (dx, dl) given (r, g).
  void solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const;

  const ConstraintFactorization& constraints() const { return constraints_; }

  /// Reciprocal condition estimate of Q2^T K Q2, relative to the magnitude of K; near zero at a fold of the
  /// equilibrium.
  double reciprocal_condition() const { return reciprocal_condition_; }

 private:
  void factor_tangent();

  Matrix K_;  ///< empty where the sparse factorization serves
  ConstraintFactorization constraints_;
  std::shared_ptr<const SparseKkt> sparse_;
  Eigen::PartialPivLU<Matrix> tangent_;
  Eigen::CompleteOrthogonalDecomposition<Matrix> singular_tangent_;
  double reciprocal_condition_ = 1.0;
};

}  // namespace eigentrail
