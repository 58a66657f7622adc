// Projection of the linearized equations onto the tangent basis (seed paper, Eqs. 12a, 26, 36).
#pragma once

#include "eigentrail/model/model.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"

namespace eigentrail {

/// The reduced pencil P(s, h) = s^2 M(h) + s C(h) + K(h); all matrices are of size n - rank.
struct ReducedPencil {
  MatrixSeries M;  ///< T^T M T
  MatrixSeries C;  ///< T^T C T
  MatrixSeries K;  ///< T^T (K + (A^T lambda)_/x) T
  /// Its diagonal blocks, where the equations fall apart into more than one part (independent_parts.hpp).
  std::vector<ReducedPencil> parts = {};
  int copies = 0;        ///< number of further parts that have the same equations, and are not among `parts`
  int complex_sign = 0;  ///< of a complex part (complex_blocks.hpp); else 0

  /// The equations of one part; all of them where they do not fall apart.
  const ReducedPencil& of(int part) const {
    return parts.empty() ? *this : parts[static_cast<std::size_t>(part)];
  }
  Eigen::Index size() const { return M[0].rows(); }
};

/// T^T B T as a power series up to h^order: coefficient k is the sum over i + j + l = k of T_i^T B_j T_l (Eq.
/// 36 for k = 1). Trailing zero coefficients are not stored, so constants cost nothing beyond order 0. For
/// sparse coefficients the product B T costs O(n - rank) per nonzero of B.
MatrixSeries project(const TangentBasis& basis, const SystemSeries& B, int order);

/// Projects M, C and K of a linearization, up to h^order.
ReducedPencil reduce(const Linearization& linearization, const TangentBasis& basis, int order);

}  // namespace eigentrail
