// Single modes as the dense output of the last step goes on.
//
// Beyond a step the two-point expansion with all coefficients of both ends is far more accurate than the
// series of one of them as long as the mode is smooth: easy modes then pass a point as they are, and others
// start their correction nearer to its end.
#pragma once

#include <optional>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Track `index` of `node` continued over h, from the step of length `last` that led from `previous` to the
/// node, both in the path's coordinate. Empty for blocks, and where the track was not followed as it is.
std::optional<ContinuedMode> continue_mode(const PathNode& previous, const PathNode& node, std::size_t index,
                                           double last, double h);

}  // namespace eigentrail
