// Describes a scene in sentences.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail::app {

/// Numbers of coordinates, constraints, redundant constraints and freedoms at the start of a trace.
struct Sizes {
  long long coordinates = 0, constraints = 0, redundant = 0, freedoms = 0;
};

/// Sentences on the freedoms, the instabilities that are possible, the equilibrium, and the trace.
std::vector<std::string> in_words(const TraceSetup& setup, const Structure& structure, const Sizes& sizes);

/// A sentence per shaft that is free to move along its axis, to turn about it, or to move across it, and the
/// table that holds it. For other models one sentence with the names of all motions that no force holds for
/// any value of the parameter. `point`: any point of the model; `parts`: in which it falls apart, or null.
std::vector<std::string> free_motions_in_words(const Model& model, const PathPoint& point,
                                               const IndependentParts* parts);

}  // namespace eigentrail::app
