// Why a trace cannot go on, in words for the user.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The message of a trace whose steps became too small after `node`, `verdict` being the last refusal.
std::string too_small_message(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                              const Verdict& verdict);

}  // namespace eigentrail
