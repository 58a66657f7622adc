// What a scene asks for, in sentences.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail::app {

/// Sizes of a system at the beginning of its trace.
struct Sizes {
  long long coordinates = 0, constraints = 0, redundant = 0, freedoms = 0;
};

/// What moves, what can happen to its eigenvalues, what is followed.
std::vector<std::string> in_words(const TraceSetup& setup, const Structure& structure, const Sizes& sizes);

}  // namespace eigentrail::app
