// From an extremum of the damping along a line to that of the plane, or to the boundary on the way.
#pragma once

#include "stability/line_scan.hpp"

namespace eigentrail {

/// Walks uphill (sign 1) or downhill in both parameters with the gradient and the Hessian of the mode, in
/// steps of `radius` (scaled) at most. Returns a seed when stability changes on the way; none when an
/// extremum or the edge of the window is reached without.
std::optional<BoundarySeed> walk_to_boundary(const Window& window, const BoundaryOptions& options,
                                             const LineExtremum& start, double radius, RunCounts& counts);

}  // namespace eigentrail
