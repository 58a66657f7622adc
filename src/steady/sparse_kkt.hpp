// The KKT matrix of a large model with independent constraints, factored as a whole by sparse LU
// (core/sparse_factors.hpp), with further unknowns and equations (steady/bordered_kkt.hpp) if there are some:
//
//     [ K     c S^T  F' ] [ dx     ]   [ r     ]
//     [ c S   0      G' ] [ dl / c ] = [ c D g ]     S = D A with rows of unit length, c the magnitude of K
//     [ X'    L'     U' ] [ du'    ]   [ h'    ]     the border scaled to the magnitude of K
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/sparse_factors.hpp"
#include "steady/bordered_kkt.hpp"

namespace eigentrail {

/// Entries of [K, (D A)^T; D A, 0], where D is the diagonal matrix of `row_scale`, m.
template <class Scalar>
std::vector<Eigen::Triplet<Scalar>> kkt_entries(const Eigen::SparseMatrix<Scalar>& K, const SparseMatrix& A,
                                                const Vector& row_scale) {
  const Eigen::Index n = K.rows();
  std::vector<Eigen::Triplet<Scalar>> entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros() + 2 * A.nonZeros()));
  for (Eigen::Index j = 0; j < n; ++j) {
    for (typename Eigen::SparseMatrix<Scalar>::InnerIterator entry(K, j); entry; ++entry)
      entries.emplace_back(entry.row(), j, entry.value());
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const Scalar value = row_scale[entry.row()] * entry.value();
      entries.emplace_back(n + entry.row(), j, value);
      entries.emplace_back(j, n + entry.row(), value);
    }
  }
  return entries;
}

/// Unit vectors, n, that are nearest to the right and the left kernel of [K, A^T; A, 0].
struct KktKernel {
  Vector right, left;

  /// By which the system is regular also where [K, A^T; A, 0] is singular.
  KktBorder border(Eigen::Index n_constraints) const;
};

class SparseKkt {
 public:
  /// Below this reciprocal condition of Q2^T K Q2, the rounding level, it counts as singular, and the
  /// null-space method is used, which separates the singular part. A beam of a thousand elements has 1e-12.
  static constexpr double least_reciprocal_condition = 1e-14;

  /// Factors the system without border; null if it is singular or its condition is beyond the limit.
  static std::shared_ptr<const SparseKkt> factor(const SparseMatrix& K, const SparseMatrix& A);
  /// K n x n, A m x n with independent rows.
  SparseKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border);

  /// Solves for (dx, dl) given (r, g), and du given h. Not finite if the matrix is singular.
  void solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl, Vector& du) const;

  /// Estimate of the reciprocal condition of Q2^T K Q2, relative to the magnitude of K. For g = 0, dx = Q2
  /// (Q2^T K Q2)^-1 Q2^T r; the norm of this map is the norm of the inverse of Q2^T K Q2 and is estimated by
  /// power iteration.
  double reciprocal_condition() const { return reciprocal_condition_; }

  /// Of [K, A^T; A, 0].
  LogDeterminant determinant() const;

 private:
  friend std::optional<KktKernel> kkt_kernel(const SparseMatrix& K, const SparseMatrix& A);

  SparseKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border, SparseKind kind);
  double norm_of_tangent_inverse() const;

  Eigen::Index n_, m_;
  Vector rows_;  ///< scales of all n + m + q equations; those of the constraints, c D, scale multipliers, too
  Vector columns_;  ///< q: what the further unknowns are counted in
  SparseMatrix matrix_;
  SparseFactors lu_;
  bool is_regular_ = false;
  double reciprocal_condition_ = 0.0;
};

/// The kernel of a system that is singular up to rounding, by inverse iteration. Empty if a pivot is zero.
std::optional<KktKernel> kkt_kernel(const SparseMatrix& K, const SparseMatrix& A);

/// A smooth function of K and A that is zero where [K, A^T; A, 0] is singular: the unknown of its equations
/// bordered by the kernel at a place nearby (Govaerts, Numerical Methods for Bifurcations of Dynamical
/// Equilibria, SIAM 2000, section 3.3). Where the sign of the determinant is already rounding it still has
/// digits.
double singularity_test(const SparseMatrix& K, const SparseMatrix& A, const KktKernel& nearby);

}  // namespace eigentrail
