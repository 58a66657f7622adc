// Scales that may be divided by.
#pragma once

#include <cmath>

namespace eigentrail {

/// A magnitude as a scale; one where it is zero or not finite, and thus tells nothing.
inline double positive_or_one(double size) {
  return size > 0.0 && std::isfinite(size) ? size : 1.0;
}

}  // namespace eigentrail
