// Where a trace ends its steps because the model changes on a small part of the range.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Values of the traced parameter at which an expression of the model has a narrow bump or a steep
/// transition, and those beside its kinks, on both sides; ascending. Cost: that of narrow_places.
std::vector<double> narrow_landings(const PathProblem& problem, const TraceOptions& options);

}  // namespace eigentrail
