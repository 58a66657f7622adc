// Projection of the linearized equations on the tangent basis (seed paper, Eqs. 12a, 26, 36).
#pragma once

#include "eigentrail/model/model.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"

namespace eigentrail {

/// P(s, h) = s^2 M(h) + s C(h) + K(h), all of size n - rank.
struct ReducedPencil {
  MatrixSeries M;  ///< T^T M T
  MatrixSeries C;  ///< T^T C T
  MatrixSeries K;  ///< T^T (K + (A^T lambda)_/x) T

  Eigen::Index size() const { return M[0].rows(); }
};

/// T^T B T in series arithmetic up to h^order: coefficient k is the sum over i + j + l = k of T_i^T B_j T_l
/// (Eq. 36 for k = 1). Series that end early are short, so constants cost nothing beyond order 0.
MatrixSeries project(const TangentBasis& basis, const MatrixSeries& B, int order);

/// The same of coefficients that may be sparse, which makes B T a product of cost O(n - rank) per entry of B.
MatrixSeries project(const TangentBasis& basis, const SystemSeries& B, int order);

ReducedPencil reduce(const Linearization& linearization, const TangentBasis& basis, int order);

}  // namespace eigentrail
