// Conversion between modes of the real pencil lambda M + K and pairs of the quadratic pencil s^2 M + K.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/modes/symmetric_pairs.hpp"

namespace eigentrail {

/// Power series of the modes of a block; L[0] is diagonal.
struct RealSeries {
  std::vector<Matrix> X;  ///< n x k
  std::vector<Matrix> L;  ///< k x k
};

/// The square roots of lambda that a start follows; empty if the start requires another method.
std::optional<Root> root_of(const InvariantPair& start);

/// Real orthonormal basis (n x k) of the space of the columns of Z; empty if Re Z and Im Z do not span k real
/// directions.
std::optional<Matrix> real_basis(const ComplexMatrix& Z, Eigen::Index k);

/// Power series of the pair of a block, normalized by W0^H Z + W1^H Z Lambda = I.
PairSeries pair_series(Root root, const RealSeries& modes, const ComplexMatrix& W);

/// Sensitivity of that pair, as PairFactorization::sensitivity, by its rows of the inverse of the modal basis
/// in state space. X (n x k) is M-orthonormal.
PairSensitivity sensitivity(Root root, const Matrix& X, const Vector& lambda, const ComplexMatrix& W,
                            const Vector& terms);

}  // namespace eigentrail
