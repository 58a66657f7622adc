// The linear system of the steady equations (KKT system; seed paper, Eq. 38), solved by the null-space
// method:
//
//     [ K  A^T ] [ dx ]   [ r ]
//     [ A   0  ] [ dl ] = [ g ]        K = -f_/x + (A^T lambda)_/x
//
// Dependent constraints thus need no special treatment; dl is then the solution of minimum norm.
//
// A sparse system with independent constraints and nonsingular Q2^T K Q2 is factored as a whole
// (steady/sparse_kkt.hpp), without Q2.
#pragma once

#include <Eigen/LU>

#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {

class SparseKkt;

class KktFactorization {
 public:
  KktFactorization() = default;

  /// Factors the system. Cost O(n m^2 + (n - m)^3), less with the sparse factorization. If Q2^T K Q2 is
  /// singular (a rigid-body freedom), solutions are those of minimum norm.
  KktFactorization(const SystemMatrix& K, const SystemMatrix& A);

  /// Factors only the constraints, for points whose equilibrium is known; `solve` must not be called then.
  explicit KktFactorization(const SystemMatrix& A) : constraints_(A) {}

  bool can_solve() const { return sparse_ != nullptr || K_.size() > 0; }

  /// Solves for (dx, dl) given (r, g).
  void solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const;

  const ConstraintFactorization& constraints() const { return constraints_; }

  /// Estimate of the reciprocal condition of Q2^T K Q2, relative to the magnitude of K. Near zero at a fold
  /// of the equilibrium path.
  double reciprocal_condition() const { return reciprocal_condition_; }

 private:
  void factor_tangent();

  Matrix K_;  ///< empty if the sparse factorization is used
  ConstraintFactorization constraints_;
  std::shared_ptr<const SparseKkt> sparse_;
  Eigen::PartialPivLU<Matrix> tangent_;
  Eigen::CompleteOrthogonalDecomposition<Matrix> singular_tangent_;
  double reciprocal_condition_ = 1.0;
};

}  // namespace eigentrail
