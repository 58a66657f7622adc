// Estimated errors of the dense output on the step from `left` to `right`, of length h, had its modes been
// followed otherwise.
#pragma once

#include "continuation/tracks/partner.hpp"
#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

/// Of a track and its partners, had they been one block; infinite where it cannot be told.
double error_as_block(const PathNode& left, const PathNode& right, std::size_t track,
                      const std::vector<Partner>& partners, double h, double least_gap);

/// Of a single mode in its other chart, relative to max(|mu|, reference); infinite for a block.
double error_in_other_chart(const PathProblem& problem, const PathNode& left, const PathNode& right,
                            std::size_t track, double h);

/// Of every eigenvalue of a block, had it been followed alone in the better chart for it, relative to
/// max(|mu|, reference).
Vector errors_as_singles(const PathProblem& problem, const PathNode& left, const PathNode& right,
                         std::size_t track, double h);

}  // namespace eigentrail
