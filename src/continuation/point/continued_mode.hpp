// Extrapolation of single modes from the dense output of the last step.
//
// Beyond a step, the two-point expansion with all coefficients of both ends is far more accurate than the
// series of one end, as long as the mode is smooth. Smooth modes are then accepted at the next point without
// correction; for others the correction starts from a better prediction.
#pragma once

#include <optional>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Track `index` of `node` extrapolated to the distance h behind the node, from the step of signed length
/// `last` between the point of the tracks `previous` and the node, both lengths in the path's coordinate.
/// Empty for blocks, for tracks that were not followed unchanged on that step, and for those accepted without
/// correction at either end.
std::optional<ContinuedMode> continue_mode(const std::vector<Track>& previous, const PathNode& node,
                                           std::size_t index, double last, double h);

}  // namespace eigentrail
