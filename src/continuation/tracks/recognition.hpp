// A mode that is known at another point, recognized at this one.
#pragma once

#include <optional>

#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

/// Whether a track of the node has an eigenpair in common with this one.
bool is_followed(const PathProblem& problem, const PathNode& node, const Track& track);

/// The track at `node` that a pair leads to. `start`: the pair elsewhere, or as predicted here, Z in physical
/// coordinates. Empty where the corrector does not converge, the shape becomes another one, or another track
/// has the eigenpair. The numbers of its modes are not set.
std::optional<Track> recognize(const PathProblem& problem, const PathNode& node, InvariantPair start,
                               RunCounts& counts);

}  // namespace eigentrail
