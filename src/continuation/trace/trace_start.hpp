// The first point of a trace: the equilibrium, the whole spectrum, and the choice of the followed modes.
#pragma once

#include "continuation/trace/trace_state.hpp"

namespace eigentrail {

/// The reason why the first point of a trace could not be computed.
struct StartFailure {
  TraceStatus status = TraceStatus::completed;
  std::string message;
};

/// Computes the first point and stores it in state.origin.node. Also sets the settings in `state` and
/// `problem`, the numbers of the start in the result, and the frame's bridge if the trace begins on a branch
/// point. Returns the reason of a failure. Cost: one spectrum, O(n^3); two on a branch point.
std::optional<StartFailure> compute_start(const PointSolver& solver, const TraceOptions& options,
                                          PathProblem& problem, TraceState& state);

/// Length of the first step in the traced parameter, > 0: as the options give it, or short enough by the
/// series at `node` to be rarely rejected.
double first_step(const PathNode& node, const PathProblem& problem, const TraceOptions& options);

/// Orders the modes behind the first point in the tracks whose eigenvalues coincide there (`meets`, per
/// track). Returns the modes that begin there.
std::vector<Birth> order_first_departure(const std::vector<bool>& meets, const PathFrame& frame,
                                         PathNode& node, ModeNumbers& numbers);

}  // namespace eigentrail
