// Estimated errors of the dense output on the step from `left` to `right`, of signed length h, if its modes
// were grouped in another way. The decisions to join modes and to separate blocks use them.
#pragma once

#include "continuation/tracks/partner.hpp"
#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

/// Number of eigenvalues of a track; one where all are the same to the root of rounding, as those of equal
/// parts.
Eigen::Index distinct_eigenvalues(const Track& track);

/// Absolute error of the eigenvalues of a track and its partners as one block. `least_gap`: distances of
/// eigenvalues count as no less. Infinite if their series are not known.
double error_as_block(const PathNode& left, const PathNode& right, std::size_t track,
                      const std::vector<Partner>& partners, double h, double least_gap);

/// Error of a single mode in the other chart, relative to max(|mu|, reference). Infinite for a block.
double error_in_other_chart(const PathProblem& problem, const PathNode& left, const PathNode& right,
                            std::size_t track, double h);

/// Error of every eigenvalue of a block as a single mode, in the chart in which it is smaller, relative to
/// max(|mu|, reference). Infinite where it is not known.
Vector errors_as_singles(const PathProblem& problem, const PathNode& left, const PathNode& right,
                         std::size_t track, double h);

}  // namespace eigentrail
