// The modes of a point: corrected, then differentiated, one by one or all at once.
#pragma once

#include "eigentrail/continuation/prediction.hpp"

namespace eigentrail {

/// Whether that many modes of a pencil of size n are worth more than one thread.
bool is_worth_sharing(std::size_t modes, Eigen::Index n);

/// Corrects the predicted pairs at a reduced point.
void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts);

/// Series of all pairs of a point, the way they were corrected.
std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts);

/// Series of one block at a point that is already differentiated.
Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts);

}  // namespace eigentrail
