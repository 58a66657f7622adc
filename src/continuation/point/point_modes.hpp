// The modes of a point: corrected, then differentiated, one by one or all at once.
#pragma once

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Corrects the predicted pairs at a reduced point.
void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts);

/// Series of all pairs of a point, the way they were corrected.
std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts);

}  // namespace eigentrail
