// The KKT matrix of a large model with independent constraints, factored as a whole:
//
//     [ K     c S^T ] [ dx     ]   [ r       ]
//     [ c S   0     ] [ dl / c ] = [ c D g   ]      S = D A with rows of unit length, c the magnitude of K
//
// by sparse LU (core/sparse_factors.hpp).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/sparse_factors.hpp"

namespace eigentrail {

/// Entries of [K, (D A)^T; D A, 0], where D is the diagonal matrix of `row_scale`, m.
using KktEntries = std::vector<Eigen::Triplet<double>>;
KktEntries kkt_entries(const SparseMatrix& K, const SparseMatrix& A, const Vector& row_scale);

/// Such scales, m: those that make the rows of A as large as K, whose magnitude is given.
Vector row_scales(const SparseMatrix& A, double magnitude);

/// Unit vectors, n, that are nearest to the right and the left kernel of [K, A^T; A, 0].
struct KktKernel {
  Vector right, left;
};
/// The kernel of a system that is singular up to rounding, by inverse iteration. Empty if a pivot is zero.
std::optional<KktKernel> kkt_kernel(const SparseMatrix& K, const SparseMatrix& A);

class SparseKkt {
 public:
  /// Below this reciprocal condition of Q2^T K Q2, the rounding level, it counts as singular, and the
  /// null-space method is used, which separates the singular part. A beam of a thousand elements has 1e-12.
  static constexpr double least_reciprocal_condition = 1e-14;

  /// Factors the system; null if it is singular or its condition is beyond the limit.
  static std::shared_ptr<const SparseKkt> factor(const SparseMatrix& K, const SparseMatrix& A);

  /// Solves for (dx, dl) given (r, g).
  void solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const;

  /// Estimate of the reciprocal condition of Q2^T K Q2, relative to the magnitude of K. For g = 0, dx = Q2
  /// (Q2^T K Q2)^-1 Q2^T r; the norm of this map is the norm of the inverse of Q2^T K Q2 and is estimated by
  /// power iteration.
  double reciprocal_condition() const { return reciprocal_condition_; }

  /// Of [K, A^T; A, 0].
  LogDeterminant determinant() const;

 private:
  SparseKkt() = default;

  Vector refined_solution(const Vector& right) const;
  double norm_of_tangent_inverse();

  Eigen::Index n_ = 0;
  Vector row_scale_;  ///< c D
  SparseMatrix matrix_;
  SparseFactors lu_;
  double reciprocal_condition_ = 0.0;
};

}  // namespace eigentrail
