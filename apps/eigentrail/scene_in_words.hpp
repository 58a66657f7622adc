// Describes a scene in sentences.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail::app {

/// Numbers of coordinates, constraints, redundant constraints and freedoms at the start of a trace.
struct Sizes {
  long long coordinates = 0, constraints = 0, redundant = 0, freedoms = 0;
};

/// Sentences on the freedoms, the instabilities that are possible, the equilibrium, and the trace.
std::vector<std::string> in_words(const TraceSetup& setup, const Structure& structure, const Sizes& sizes);

}  // namespace eigentrail::app
