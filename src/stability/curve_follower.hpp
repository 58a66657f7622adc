// Follows a boundary from a seed in both directions.
#pragma once

#include <functional>

#include "stability/curve_step.hpp"

namespace eigentrail {

struct FollowOptions {
  double tolerance = 1e-6;  ///< as TraceOptions
  int max_points = 100000;  ///< of one curve, in either direction
};

struct FollowedCurve {
  BoundaryFunction function;
  std::vector<CurvePoint> points;
  std::vector<ChordStep> steps;  ///< one less than points
  CurveEnd begin = CurveEnd::lost, end = CurveEnd::lost;
  std::string begin_reason, end_reason;

  /// Whether the dense curve passes the place with this eigenvalue.
  bool passes(const Place& place, Complex s, double tolerance, double s_ref) const;
};

/// Called after every point; returns whether to go on.
using OnPoint = std::function<void()>;

FollowedCurve follow_curve(const Window& window, const BoundaryFunction& function,
                           const FollowOptions& options, CurvePoint seed, const OnPoint& on_point,
                           int& rejected, RunCounts& counts);

}  // namespace eigentrail
