// Interpolation of a vector of functions of one variable by polynomials in pieces, with few evaluations.
//
// On a piece the values are taken at Chebyshev points of the second kind, x_j = cos(pi j / N), for N = 4, 8,
// 16, 32: the points of one N are among those of the next. The polynomial of degree N/2 is compared with the
// values at the new points; for smooth functions the error of degree N is about the square of that. If 33
// points are not enough, or will not be, the piece is halved. A polynomial that is accepted is compared with
// further values where points are farther apart than the resolution.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// x_j, j = 0 ... degree, for a degree of at least 1.
double chebyshev_point(int j, int degree);

/// A piece with the Chebyshev coefficients of all functions: f_i(p) = sum_j coefficients(i, j) T_j(x).
struct ChebyshevPiece {
  double from = 0.0, to = 0.0;
  Matrix coefficients;
};

struct PiecewiseOptions {
  std::vector<double> ends;  ///< ends of the first pieces, ascending, at least two
  double tolerance = 1e-11;  ///< relative to the largest magnitude of each function
  int max_calls = 1000;
  double resolution = 1.0;  ///< largest distance of two evaluations, as a share of the range; > 0
};

/// What could not be resolved: a piece, the function with the largest error, and this error in units of the
/// largest magnitude of the function.
struct Unresolved {
  double from = 0.0, to = 0.0;
  Eigen::Index worst = 0;
  double error = 0.0;
};

struct PiecewiseResult {
  std::vector<ChebyshevPiece> pieces;  ///< ascending
  int calls = 0;
  std::vector<Unresolved> unresolved;  ///< empty, or the piece at which the interpolation was given up
};

/// Interpolates `f`; `rounding(largest)` gives, from the largest magnitudes of all functions so far, the
/// errors that are rounding. What f throws passes through. Cost beside the calls: O(N^2) per function and
/// piece.
PiecewiseResult interpolate_in_pieces(const std::function<Vector(double)>& f, const PiecewiseOptions& options,
                                      const std::function<Vector(const Vector&)>& rounding);

}  // namespace eigentrail
