// Where boundaries meet.
#pragma once

#include "stability/curve_follower.hpp"

namespace eigentrail {

struct FoundCorners {
  std::vector<Corner> corners;  ///< places in the parameters' units
  std::vector<Place> apart;     ///< scaled places where curves cross that belong to different equilibria
};

/// Intersections of all curves with each other and with themselves, both modes tracked anew there; and the
/// points where curves of pairs end on curves of divergence.
FoundCorners find_corners(const Window& window, const std::vector<FollowedCurve>& curves, double tolerance,
                          RunCounts& counts);

}  // namespace eigentrail
