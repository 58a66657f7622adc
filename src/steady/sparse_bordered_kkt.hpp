// The KKT system of a large model with further unknowns and equations (steady/bordered_kkt.hpp), by one
// sparse LU of the whole matrix: rows and columns are scaled to the magnitude of K.
#pragma once

#include "core/sparse_factors.hpp"
#include "steady/bordered_kkt.hpp"

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

}  // namespace eigentrail
