// Follows an extremum of the instability along a line over the plane, to an extremum in both parameters or to
// the boundary if it lies on the way.
#pragma once

#include "stability/line_scan.hpp"

namespace eigentrail {

/// Maximizes (start.sign = 1) or minimizes the instability of a mode over both parameters, by Newton's method
/// with second derivatives in a trust region of at most `radius` (scaled). Returns a seed if the instability
/// changes its sign on the way; empty if an extremum or the edge of the window is reached before, or the
/// mode cannot be computed.
std::optional<BoundarySeed> walk_to_boundary(const Window& window, const BoundaryOptions& options,
                                             const LineExtremum& start, double radius, RunCounts& counts);

}  // namespace eigentrail
