// A function along the path as polynomials on pieces of it: small enough for a page, and accurate enough to
// read numbers off.
//
// Each piece is the polynomial of degree d through its values at the Chebyshev-Lobatto places
// (1 - cos(pi j / d)) / 2, j = 0..d. Pieces are halved until the function is met between those places too;
// they end at points of the trace where they cover more than one step, since the function is smooth between
// those only.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A stretch without gaps.
struct PiecewiseCurve {
  std::vector<double> knots;    ///< ends of the pieces, ascending; one more than pieces
  std::vector<Complex> values;  ///< d per piece and one behind them: neighbours share their ends
};

struct PiecewiseOptions {
  std::size_t degree = 6;       ///< d >= 2
  double real_tolerance = 0.0;  ///< of the real part, > 0
  double imag_tolerance = 0.0;  ///< of the imaginary part, > 0
  double largest = 0.0;  ///< what exceeds this in absolute value is left out: the curve has a gap there
};

/// Approximates a function on [nodes.front(), nodes.back()]; it is smooth between neighbouring nodes, which
/// ascend. `value(i, t)` is the function at t in [0, 1] between nodes i and i + 1. Several curves where parts
/// are left out, none where nothing remains.
std::vector<PiecewiseCurve> approximate(const std::vector<double>& nodes,
                                        const std::function<Complex(std::size_t, double)>& value,
                                        const PiecewiseOptions& options);

}  // namespace eigentrail
