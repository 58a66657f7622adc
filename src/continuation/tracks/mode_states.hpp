// The modes of a point one by one, as the loci file stores them.
#pragma once

#include "continuation/tracks/mode_copies.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// Every mode that exists before or behind the point, those of `copies` included. `traced`: index of the
/// traced parameter. `along`: error of the place on the path by rounding, in its coordinate, which is one of
/// the eigenvalues, too.
std::vector<ModeState> mode_states(const PathNode& node, int traced, const ModeCopies& copies = {},
                                   const RoundingThresholds& thresholds = {}, double along = 0.0);

}  // namespace eigentrail
