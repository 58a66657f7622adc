// Scales that are safe to divide by.
#pragma once

#include <cmath>

namespace eigentrail {

/// `size` if it is positive and finite, otherwise 1.
inline double positive_or_one(double size) {
  return size > 0.0 && std::isfinite(size) ? size : 1.0;
}

}  // namespace eigentrail
