// What a scene simulates, and how it will be solved.
#pragma once

#include <cstdio>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/core/sparse_solver.hpp"
#include "eigentrail/projection/route.hpp"

namespace eigentrail::app {

/// Writes effects, structure, sizes and chosen solvers. `sensitivity`: ranks the effects by their influence
/// on each mode where the trace begins; `options` are the overrides that the setup was prepared with;
/// `solver`: what would factor a large model. Returns the way that a trace would take. Throws InputError.
Route explain(std::FILE* to, const TraceSetup& setup, const OptionTexts& options, bool sensitivity,
              const SparseSolverMaker& solver = {});

}  // namespace eigentrail::app
