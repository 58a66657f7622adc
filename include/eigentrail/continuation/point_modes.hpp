// Correction and differentiation of the modes of a point, one by one or all at once.
#pragma once

#include "eigentrail/continuation/prediction.hpp"

namespace eigentrail {

/// Whether the work on that many modes of a pencil of size n pays for the start of several threads.
bool is_worth_sharing(std::size_t modes, Eigen::Index n);

/// Corrects the predicted pairs at a reduced point. Sets the point's pairs, or its status if a pair does not
/// converge.
void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts);

/// Tracks with the series of all pairs of a point, computed by the route that corrected them. `node` holds
/// the series of basis and pencil.
std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts);

/// Track with the series of one corrected pair at a point whose pencil is already differentiated.
Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts);

}  // namespace eigentrail
