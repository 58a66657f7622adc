// Rigid-body motions against which nothing acts, for `explain`.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail::app {

/// A sentence per shaft that is free to move along its axis, to turn about it, or to move across it, and the
/// table that holds it. For other models one sentence with the names of all motions that no force holds for
/// any value of the parameter. `point`: any point of the model; `parts`: in which it falls apart, or null.
std::vector<std::string> free_motions_in_words(const Model& model, const PathPoint& point,
                                               const IndependentParts* parts);

}  // namespace eigentrail::app
