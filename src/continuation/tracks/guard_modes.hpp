// Guard modes: eigenvalues that are not followed but come close to one that is. They belong to its block as
// long as both are close.
#pragma once

#include "continuation/tracks/partner.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Adds those eigenvalues at a point that no track has and that are nearest to a track, as tracks of guard
/// modes behind the others. They are found by inverse iteration about the track; nothing is added to models
/// of more than a thousand freedoms. Cost: an LU of size 2n, and a correction of each.
void add_neighbours(const PathProblem& problem, PathNode& node, std::size_t track, RunCounts& counts);

/// Removes the tracks that consist of guard modes.
void remove_guards(PathNode& node);

/// Joins a track with a mode that is not followed, if it meets one within `reach` steps of signed length h,
/// or if the nearest one is closer than all that are followed. Returns whether it did. Cost: add_neighbours.
bool join_unfollowed(const PathProblem& problem, PathNode& node, std::size_t track, double h, double reach,
                     RunCounts& counts);

}  // namespace eigentrail
