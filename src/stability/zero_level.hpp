// What counts as zero at the stored points of a path.
#pragma once

#include <algorithm>
#include <cmath>

#include "eigentrail/core/types.hpp"
#include "modes/double_zero.hpp"

namespace eigentrail {

/// At stored points |Re s| below this multiple of max(|s|, reference) counts as zero. Without this, rounding
/// would make undamped systems alternate between stable and unstable.
constexpr double vanishing_damping = 1e-9;
/// An eigenvalue larger than this multiple of the reference counts as passing through infinity.
constexpr double infinite_size = 1e9;
/// A mode that begins or ends and is larger than this multiple of the reference comes from infinity or runs
/// there: typical eigenvalues are a thousand references, and modes that run to infinity end a hundred times
/// above the largest one at the start.
constexpr double large_size = 1e4;

/// Magnitude up to which an eigenvalue of a block counts as zero, 1/s: it may be a double one. `s`: all
/// eigenvalues, 1/s; those that are not finite do not count.
inline double zero_of_blocks(const ComplexVector& s, double reference) {
  double largest = 0.0;
  for (const Complex value : s) {
    if (std::isfinite(value.real())) largest = std::max(largest, std::abs(value));
  }
  return double_zero * std::min(largest, infinite_size * reference);
}

}  // namespace eigentrail
