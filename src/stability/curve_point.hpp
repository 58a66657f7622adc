// A point of a boundary with the power series of the curve through it, and the step to the next one.
#pragma once

#include <optional>

#include "stability/boundary_mode.hpp"

namespace eigentrail {

/// In the point's own coordinate u: place + u tangent + nu(u) normal, all scaled.
struct CurvePoint {
  Place place;
  Place tangent, normal;               ///< of unit length; the normal is the direction of grad g
  Matrix places;                       ///< 2 x (order + 2): series of the place in u
  Path path;                           ///< equilibrium
  PairSeries mode;                     ///< Z in physical coordinates
  ComplexMatrix functions;             ///< k x (order + 2)
  Vector left;                         ///< left null vector of the stiffness (divergence)
  Matrix basis;                        ///< tangent basis
  double equilibrium_condition = 1.0;  ///< reciprocal, of the equilibrium's stiffness
  bool solves_equilibrium = false;     ///< whether that says anything
  Complex s;
  ComplexVector shape;  ///< physical coordinates
  int others = 0;       ///< other unstable modes
  double gap = 0.0;     ///< distance of s from the nearest other eigenvalue with Im s >= 0
  int number = 0;       ///< of the mode by ascending |s|, from 1
  int flags = 0;

  double tau() const { return functions(0, 0).real(); }
  double delta() const { return functions.rows() > 1 ? functions(1, 0).real() : 0.0; }
};

/// Why a point was not found.
struct PointTrouble {
  PointStatus status = PointStatus::computed;
  std::string message;
};

/// The series of the curve through a situation on it, its tangent on the side of `along` (zero: with the
/// region where g > 0 to its left).
std::optional<CurvePoint> expand_curve(const Window& window, const BoundaryFunction& function,
                                       const Situation& situation, const Place& along, RunCounts& counts);

/// The same where the gradient of g vanishes: with the series (4 x (order + 2): place, tau, delta; in any
/// variable) that the dense curve has there. What only predictions need is that of the neighbour.
CurvePoint point_on_dense_curve(const Window& window, const BoundaryFunction& function,
                                const Situation& situation, const Matrix& series, const CurvePoint& neighbour,
                                RunCounts& counts);

/// Where the curve is expected at u = h.
PlaceGuess predict(const CurvePoint& point, double h);

/// Newton from a guess for g = 0 along a direction.
Situation correct_along(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                        const Place& direction, RunCounts& counts);

/// Newton from a guess for the end of the curve where tau = delta = 0.
Situation correct_to_end(const Window& window, const BoundaryFunction& function, PlaceGuess guess,
                         RunCounts& counts);

}  // namespace eigentrail
