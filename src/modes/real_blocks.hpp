// Between modes of the real pencil lambda M + K and pairs of the quadratic pencil s^2 M + K.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/modes/symmetric_pairs.hpp"

namespace eigentrail {

/// Series of the modes of a block; L[0] is diagonal.
struct RealSeries {
  std::vector<Matrix> X;  ///< n x k
  std::vector<Matrix> L;  ///< k x k
};

/// The roots that a start follows; empty where it is one of a kind that needs another route.
std::optional<Root> root_of(const InvariantPair& start);

/// Orthonormal real basis (n x k) of vectors Z that span k real directions; empty where they do not.
std::optional<Matrix> real_basis(const ComplexMatrix& Z, Eigen::Index k);

/// Series of the pair of a block, with W0^H Z + W1^H Z Lambda = I.
PairSeries pair_series(Root root, const RealSeries& modes, const ComplexMatrix& W);

/// Bound of |dLambda| / |R| of that pair with the basis Z, as PairFactorization::sensitivity: its rows of the
/// inverse of the modal basis in state space. X (n x k) is M-orthonormal.
double sensitivity(Root root, const Matrix& X, const Vector& lambda, const ComplexMatrix& W);

}  // namespace eigentrail
