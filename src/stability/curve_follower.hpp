// Finds the first point of a boundary, its seed, from a place where stability changes, and follows the
// boundary from there in both directions.
#pragma once

#include <functional>

#include "stability/curve_step.hpp"
#include "stability/line_scan.hpp"

namespace eigentrail {

struct CurveStart {
  std::optional<CurvePoint> point;  ///< empty if no curve begins here
  bool failed = false;              ///< Newton's method has failed: a finding says why
  std::vector<Finding> findings;
  RunCounts counts;
};

/// Corrects a seed by Newton's method and expands the curve through it.
CurveStart start_curve(const Window& window, const BoundaryOptions& options, const BoundarySeed& seed);

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

/// Follows the curve through `seed` in both directions until it ends or closes. Of the options: `tolerance`,
/// of s and of the place in the scaled window, and `max_nodes`, in each direction from the seed.
FollowedCurve follow_curve(const Window& window, const BoundaryFunction& function,
                           const TraceOptions& options, CurvePoint seed, const OnPoint& on_point);

}  // namespace eigentrail
