// Messages to the user on why a trace ended early, or knows less than it was asked for.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// The message of a trace whose steps became too small after `node`. `verdict` is the judgement of the last
/// rejected step.
std::string too_small_message(const PathProblem& problem, const TraceOptions& options, const PathNode& node,
                              const Verdict& verdict);

/// The note that rounding keeps the eigenvalues of a track from the tolerance beside a point; `known`: their
/// relative accuracy there.
std::string rounding_note(const TraceOptions& options, const PathNode& node, const Track& track,
                          double known);

}  // namespace eigentrail
