// Follows a boundary from a starting point (seed) in both directions.
#pragma once

#include <functional>

#include "stability/curve_step.hpp"

namespace eigentrail {

struct FollowOptions {
  double tolerance = 1e-6;  ///< of the place in the scaled window, and of s as in TraceOptions
  int max_points = 100000;  ///< largest number of points of a curve in each direction from the seed
};

/// How a curve ends, and why in words; empty if the end needs none.
struct ArmEnd {
  CurveEnd how = CurveEnd::lost;
  std::string reason;
};

struct FollowedCurve {
  BoundaryFunction function;
  std::vector<CurvePoint> points;
  std::vector<ChordStep> steps;  ///< between neighbouring points: one less than points
  ArmEnd begin, end;
  int rejected_steps = 0;
  RunCounts counts;

  /// Whether the dense output passes through a scaled place with the eigenvalue `s` there, within a small
  /// multiple of the tolerance.
  bool passes(const Place& place, Complex s, double tolerance, double s_ref) const;
};

/// Called after every point.
using OnPoint = std::function<void()>;

/// Follows the curve through `seed` in both directions until it ends or closes.
FollowedCurve follow_curve(const Window& window, const BoundaryFunction& function,
                           const FollowOptions& options, CurvePoint seed, const OnPoint& on_point);

}  // namespace eigentrail
