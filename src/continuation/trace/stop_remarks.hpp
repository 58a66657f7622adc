// Messages to the user on why a trace ended early.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The message of a trace whose steps became too small after `node`. `verdict` is the judgement of the last
/// rejected step.
std::string too_small_message(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                              const Verdict& verdict);

}  // namespace eigentrail
