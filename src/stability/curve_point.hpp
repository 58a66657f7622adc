// A point of a boundary with the power series of the curve through it, and Newton's methods that find such
// points.
#pragma once

#include <optional>

#include "stability/boundary_mode.hpp"

namespace eigentrail {

/// A point with the power series of the curve in the distance u along the tangent: place + u tangent +
/// nu(u) normal, in scaled coordinates.
struct CurvePoint {
  Matrix places;                ///< 2 x (order + 2): series of the place in u
  Path path;                    ///< series of the equilibrium in u
  PairSeries mode;              ///< series of the invariant pair in u; Z in physical coordinates
  ComplexMatrix functions;      ///< k x (order + 2): series of the functions of the block in u
  Vector left;                  ///< left null vector of the stiffness (divergence)
  Matrix basis;                 ///< tangent basis at the point
  bool is_beside_fold = false;  ///< the stiffness of the equilibrium is nearly singular
  Complex s;                    ///< Im s >= 0
  ComplexVector shape;          ///< physical coordinates
  int others = 0;               ///< number of other modes that are unstable, or less damped than asked
  double gap = 0.0;             ///< distance of s from the nearest other eigenvalue with Im s >= 0
  int number = 0;               ///< number of the mode by ascending |s|, from 1
  int flags = 0;                ///< sum of PointFlag

  Place place() const { return places.col(0); }
  Place tangent() const { return places.col(1); }  ///< of unit length
};

/// The point with the series of the curve through a situation on it. The tangent has a nonnegative product
/// with `along`; if `along` is zero, the region g > 0 lies to its left. Empty if grad g vanishes or a
/// coefficient is not finite.
std::optional<CurvePoint> expand_curve(const Window& window, const BoundaryFunction& function,
                                       const Situation& situation, const Place& along, RunCounts& counts);

/// The point at a situation where grad g may vanish. The curve is given by `series`, 4 x (order + 2), of
/// place, tau and delta from the dense output, in any variable. Members that only predictions use are copied
/// from `neighbour`; no prediction may start from the result.
CurvePoint point_on_dense_curve(const Window& window, const BoundaryFunction& function,
                                const Situation& situation, const Matrix& series, const CurvePoint& neighbour,
                                RunCounts& counts);

/// The prediction of the series at u = h.
PlaceGuess predict(const CurvePoint& point, double h);

/// Newton's method for g = 0 from a guess, moving along `direction` (zero: along grad g).
Situation correct_along(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                        const Place& direction, RunCounts& counts);

/// Newton's method for tau = delta = 0, the end of a curve of complex pairs, from a guess.
Situation correct_to_end(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                         RunCounts& counts);

}  // namespace eigentrail
