// The reduced pencil at one point with 113 bits: the first two stages of a reference.
#pragma once

#include <cmath>
#include <optional>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/extended.hpp"

namespace eigentrail {

/// s^2 M + s C + K, all (n - rank A) x (n - rank A).
struct ExtendedPencil {
  ExtendedMatrix M, C, K;
  double correction = 0.0;  ///< largest last correction of the equilibrium and the basis, relative
};

/// Calls correct() until the relative size that it returns no longer halves, or is that of rounding with 113
/// bits. Returns the last size.
template <class Correct>
double refine_to_rounding(Correct&& correct) {
  constexpr int most_corrections = 60;
  constexpr double rounding = 1e-33;
  double last = INFINITY;
  for (int i = 0; i < most_corrections; ++i) {
    const double size = correct();
    if (!(size > rounding) || size > 0.5 * last) return size;
    last = size;
  }
  return last;
}

/// Refines the equilibrium and the tangent basis of a point and projects. Empty when the model has no
/// extended precision or numbers are not finite.
std::optional<ExtendedPencil> extended_pencil(const PathProblem& problem, const PathPoint& point);

}  // namespace eigentrail
