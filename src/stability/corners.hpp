// Corners: points at which boundaries intersect, or at which a curve of complex pairs ends on a curve of
// divergence.
#pragma once

#include "stability/curve_follower.hpp"

namespace eigentrail {

struct FoundCorners {
  std::vector<Corner> corners;  ///< places in the parameters' units
  std::vector<Finding> findings;
};

/// All corners of the curves, intersections of a curve with itself included. Intersections are corrected by
/// Newton's method for both modes.
FoundCorners find_corners(const Window& window, const std::vector<FollowedCurve>& curves, double tolerance,
                          RunCounts& counts);

}  // namespace eigentrail
