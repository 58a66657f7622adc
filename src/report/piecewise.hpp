// Approximates a function along the path by piecewise polynomials, with less data than its dense output.
//
// Each piece is the polynomial of degree d through the values at the Chebyshev-Lobatto points
// (1 - cos(pi j / d)) / 2, j = 0..d. A piece is divided until the error between these points is within the
// tolerance. A piece that covers several steps is divided at a point of the trace, because the function is
// smooth only between those.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A continuous part of the approximation.
struct PiecewiseCurve {
  std::vector<double> knots;    ///< ends of the pieces, ascending; one more than pieces
  std::vector<Complex> values;  ///< d * pieces + 1: neighbouring pieces share the value at their common end
};

struct CurveOptions {
  std::size_t degree = 6;       ///< d >= 2
  double real_tolerance = 0.0;  ///< absolute error of the real part, > 0
  double imag_tolerance = 0.0;  ///< absolute error of the imaginary part, > 0
  double largest = 0.0;  ///< values with a larger magnitude are left out: the approximation has a gap there
};

/// Approximates a function on [nodes.front(), nodes.back()]. `nodes` ascend; the function is smooth between
/// neighbouring ones. `value(i, t)` is the function at t in [0, 1] between nodes i and i + 1. Returns several
/// curves if parts are left out, none if everything is.
std::vector<PiecewiseCurve> approximate(const std::vector<double>& nodes,
                                        const std::function<Complex(std::size_t, double)>& value,
                                        const CurveOptions& options);

}  // namespace eigentrail
