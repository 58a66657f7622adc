// Whether a matrix equals its transpose, for dense and sparse storage.
#pragma once

#include <algorithm>
#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Whether A^T = `sign` A, entry by entry: 1 asks for a symmetric matrix, -1 for a skew-symmetric one. A zero
/// matrix is both.
template <class Storage>
bool equals_transpose(const Storage& A, double sign) {
  const Storage transposed = A.transpose();
  return (A - sign * transposed).norm() == 0.0;
}

/// Whether this holds for all matrices of a list.
inline bool all_equal_transposes(const std::vector<Matrix>& matrices, double sign) {
  return std::all_of(matrices.begin(), matrices.end(),
                     [sign](const Matrix& A) { return equals_transpose(A, sign); });
}

}  // namespace eigentrail
