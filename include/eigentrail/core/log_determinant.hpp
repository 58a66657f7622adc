// A determinant by its sign and its logarithm: that of a large matrix may overflow.
#pragma once

#include <cmath>

namespace eigentrail {

struct LogDeterminant {
  double sign = 0.0;       ///< 1 or -1; 0: the matrix is singular up to rounding
  double logarithm = 0.0;  ///< of the magnitude

  /// This determinant, with its sign, divided by the magnitude of another one.
  double relative_to(const LogDeterminant& other) const {
    return sign * std::exp(logarithm - other.logarithm);
  }
};

}  // namespace eigentrail
