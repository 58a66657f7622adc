// The curve between two points: dense output on their chord.
#pragma once

#include "stability/curve_point.hpp"

namespace eigentrail {

/// Coefficients of place, tau and delta in the distance along the chord from `left` to `right`.
struct ChordStep {
  double length = 0.0;
  Matrix left, right;                                  ///< 4 x (order + 2): scaled place, tau, delta
  Eigen::Vector2d rounding = Eigen::Vector2d::Zero();  ///< of tau and delta at the ends

  Eigen::Vector4d operator()(double t) const;
  Place place(double t) const { return (*this)(t).head<2>(); }
  /// Derivative of the place by t.
  Place slope(double t) const;

  /// Coefficients in powers of (t - t0), 4 x (order + 2).
  Matrix series(double t0) const;

  /// Estimated error of the dense output of order q as a fraction of what `tolerance` allows.
  double error(double tolerance, double s_ref) const;
};

/// Both points must look along the chord: empty when a tangent has turned by a right angle against it.
std::optional<ChordStep> make_chord_step(const CurvePoint& left, const CurvePoint& right);

/// The stored form, in the units of the parameters.
BoundaryStep stored_step(const Window& window, const ChordStep& step);

/// How far a place is from the dense curve, where it lies abreast of the chord; t is set. Infinite
/// elsewhere.
double distance_from(const ChordStep& step, const Place& place, double& t);

}  // namespace eigentrail
