// The matrices of a pencil whose coordinates are numbered along the model, in band storage.
#pragma once

#include <memory>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// M, C and K, n x n, of which the entries further than `width` from the diagonal are zero: A(i, j) in row
/// width + i - j and column j, (2 width + 1) x n. Null where they are not known to be banded. Copies share
/// them.
struct PencilBands {
  std::shared_ptr<const Matrix> M, C, K;

  explicit operator bool() const { return M != nullptr; }
  /// a M + b C + c K in the same storage.
  ComplexMatrix sum(Complex a, Complex b, double c) const;
};

}  // namespace eigentrail
