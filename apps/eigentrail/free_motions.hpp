// Rigid-body motions of shafts against which nothing acts, for `explain`.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail::app {

/// A sentence per shaft that is free to move along its axis, to turn about it, or to move across it, and the
/// table that holds it. `K`: stiffness in the coordinates of the model, n x n.
std::vector<std::string> free_motions_in_words(const ModelDescription& description, const Matrix& K);

}  // namespace eigentrail::app
