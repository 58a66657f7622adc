// The KKT matrix of large models with independent constraints, factored as a whole:
//
//     [ K     c S^T ] [ dx     ]   [ r       ]
//     [ c S   0     ] [ dl / c ] = [ c D g   ]      S = D A with rows of unit length, c the magnitude of K
//
// by sparse LU with column ordering and partial pivoting.
#pragma once

#include <Eigen/SparseLU>
#include <memory>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

class SparseKkt {
 public:
  /// Where Q2^T K Q2 is closer to singular than this, the null space of A tells what remains regular.
  static constexpr double least_reciprocal_condition = 1e-11;

  /// Factors the system; null where it is singular or nearly so.
  static std::shared_ptr<const SparseKkt> factor(const SparseMatrix& K, const SparseMatrix& A);

  /// Solves for (dx, dl) given (r, g).
  void solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const;

  /// Of Q2^T K Q2, relative to the magnitude of K. With g = 0, dx = Q2 (Q2^T K Q2)^-1 Q2^T r: the norm of
  /// that map, which power iteration estimates, is the norm of the inverse of Q2^T K Q2.
  double reciprocal_condition() const { return reciprocal_condition_; }

 private:
  SparseKkt() = default;

  Vector refined_solution(const Vector& right) const;
  double norm_of_tangent_inverse();

  Eigen::Index n_ = 0;
  Vector row_scale_;  ///< c D
  SparseMatrix matrix_;
  Eigen::SparseLU<SparseMatrix> lu_;
  double reciprocal_condition_ = 0.0;
};

}  // namespace eigentrail
