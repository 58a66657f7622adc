// The curve between two neighbouring points: dense output over the chord that joins them.
#pragma once

#include "stability/curve_point.hpp"

namespace eigentrail {

/// Power series of place, tau and delta at both points, in the distance along the chord from left to right.
struct ChordStep {
  double length = 0.0;
  Matrix left, right;                                  ///< 4 x (order + 2): scaled place, tau, delta
  Eigen::Vector2d rounding = Eigen::Vector2d::Zero();  ///< rounding errors of tau and delta at the ends

  /// Scaled place, tau and delta at t in [0, 1].
  Eigen::Vector4d operator()(double t) const;
  Place place(double t) const { return (*this)(t).head<2>(); }
  /// Derivative of the place with respect to t.
  Place slope(double t) const;

  /// Coefficients in powers of (t - t0), 4 x (order + 2).
  Matrix series(double t0) const;

  /// Estimated error of the dense output, as a multiple of the error that `tolerance` allows.
  double error(double tolerance, double s_ref) const;
};

/// The step between two points. Empty if a tangent deviates so much from the chord (cosine of the angle at
/// most 0.2) that the distance along the chord is not a suitable coordinate.
std::optional<ChordStep> make_chord_step(const CurvePoint& left, const CurvePoint& right);

/// The step in the form that is stored: in the units of the parameters, and without the last coefficient of
/// the series, which serves the error estimate only.
BoundaryStep stored_step(const Window& window, const ChordStep& step);

/// Distance of a place from the point of the dense output with the same coordinate t along the chord; sets t.
/// Infinite if the place projects outside the chord.
double distance_from(const ChordStep& step, const Place& place, double& t);

}  // namespace eigentrail
