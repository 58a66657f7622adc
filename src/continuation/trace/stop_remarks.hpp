// Messages to the user on why a trace ended early, or knows less than it was asked for.
#pragma once

#include "continuation/step/step.hpp"
#include "continuation/trace/trace_state.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The message of a trace whose steps became too small after `node`. `verdict` is the judgement of the last
/// rejected step.
std::string too_small_message(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                              const Verdict& verdict);

/// Takes the modes of a point that are followed alone: of eigenvalues that meet only the functions are known.
/// `along`: error of the place on the path by rounding, in its coordinate.
void take_least_known(const PathProblem& problem, const PathFrame& frame, const PathNode& node, double along,
                      LeastKnown& least);

/// The note that rounding keeps an eigenvalue from the tolerance.
std::string rounding_note(const TraceOptions& options, const LeastKnown& least);

}  // namespace eigentrail
