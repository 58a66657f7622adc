// The linear system of the steady equations (KKT system; seed paper, Eq. 38), solved by the null-space
// method:
//
//     [ K  A^T ] [ dx ]   [ r ]
//     [ A   0  ] [ dl ] = [ g ]        K = -f_/x + (A^T lambda)_/x
//
// Dependent constraints thus need no special treatment; dl is then the solution of minimum norm.
//
// With trimmed parameters u, their columns and the rows of their conditions border the system
// (steady/bordered_kkt.hpp); du then follows dl, and the right sides of the conditions follow g.
//
// A sparse system with independent constraints and nonsingular Q2^T K Q2 is factored as a whole
// (steady/sparse_kkt.hpp), without Q2.
#pragma once

#include <Eigen/LU>

#include "eigentrail/core/constraint_factorization.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

class BorderedKkt;
class SparseKkt;

class KktFactorization {
 public:
  KktFactorization() = default;

  /// Factors the system. Cost O(n m^2 + (n - m)^3), less with the sparse factorization. If Q2^T K Q2 is
  /// singular (a rigid-body freedom), solutions are those of minimum norm.
  KktFactorization(const SystemMatrix& K, const SystemMatrix& A);

  /// The same with trimmed parameters, always with dense matrices; without any (no columns) as above.
  KktFactorization(const SystemMatrix& K, const SystemMatrix& A, const TrimDerivatives& trim);

  /// Factors only the constraints, for points whose equilibrium is known; `solve` must not be called then.
  explicit KktFactorization(const SystemMatrix& A) : constraints_(A) {}

  bool can_solve() const { return sparse_ != nullptr || bordered_ != nullptr || K_.size() > 0; }

  /// Solves for (dx, dl) given (r, g), with dl and g of size m, or m + k if k parameters are trimmed.
  void solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const;

  const ConstraintFactorization& constraints() const { return constraints_; }

  /// Estimate of the reciprocal condition of Q2^T K Q2, relative to the magnitude of K. Near zero at a fold
  /// of the equilibrium path.
  double reciprocal_condition() const { return reciprocal_condition_; }

  /// Where k parameters are trimmed and the system is singular: by how much each of them, and each condition,
  /// takes part in that, 2 x k; the columns of a regular system are zero. Empty without trim.
  Matrix undetermined() const;

  /// With trimmed parameters: sign of the determinant of the system; 0 without any.
  int orientation() const;

 private:
  void factor_tangent();

  Matrix K_;  ///< empty if the sparse factorization is used
  ConstraintFactorization constraints_;
  std::shared_ptr<const SparseKkt> sparse_;
  std::shared_ptr<const BorderedKkt> bordered_;  ///< set if parameters are trimmed
  Eigen::PartialPivLU<Matrix> tangent_;
  Eigen::CompleteOrthogonalDecomposition<Matrix> singular_tangent_;
  double reciprocal_condition_ = 1.0;
};

}  // namespace eigentrail
