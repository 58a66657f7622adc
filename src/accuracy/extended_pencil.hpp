// The reduced pencil at one point with 113 bits: the first two stages of a reference (reference.hpp).
#pragma once

#include <cmath>
#include <optional>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/extended.hpp"

namespace eigentrail {

/// The pencil s^2 M + s C + K; all matrices are (n - rank A) x (n - rank A).
struct ExtendedPencil {
  ExtendedMatrix M, C, K;
  double correction = 0.0;  ///< largest last correction of the equilibrium and the basis, relative
};

/// Calls correct(), which applies a correction and returns its relative size, until the size no longer halves
/// or is at the rounding level of 113 bits (2^-113 = 1e-34). Returns the last size.
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

/// Refines the equilibrium and the tangent basis of a point, and projects the linearization onto the basis.
/// Empty if the model cannot be evaluated in extended precision or a correction is not finite.
std::optional<ExtendedPencil> extended_pencil(const PathProblem& problem, const PathPoint& point);

}  // namespace eigentrail
