// The KKT system of a large model with further unknowns and equations (steady/bordered_kkt.hpp), by one
// sparse LU of the whole matrix: rows and columns are scaled to the magnitude of K.
#pragma once

#include "core/sparse_factors.hpp"
#include "steady/bordered_kkt.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {

class SparseBorderedKkt {
 public:
  /// K n x n, A m x n with independent rows.
  SparseBorderedKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border);

  /// Not finite if the matrix is singular.
  void solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl, Vector& du) const;

 private:
  Eigen::Index n_, m_;
  Vector rows_;     ///< scales of all n + m + q equations; those of the constraints scale multipliers, too
  Vector columns_;  ///< q: what the further unknowns are counted in
  SparseMatrix matrix_;
  SparseFactors lu_;
  bool is_regular_ = false;
};

/// A smooth function of K and A that is zero where [K, A^T; A, 0] is singular: the unknown of its equations
/// bordered by the kernel at a place nearby (Govaerts, Numerical Methods for Bifurcations of Dynamical
/// Equilibria, SIAM 2000, section 3.3). Where the sign of the determinant is already rounding it still has
/// digits.
double singularity_test(const SparseMatrix& K, const SparseMatrix& A, const KktKernel& nearby);

}  // namespace eigentrail
