// The first point of a trace: the equilibrium, the whole spectrum, and the modes that are followed.
#pragma once

#include "continuation/trace/trace_state.hpp"

namespace eigentrail {

/// Why a trace has no first point.
struct StartFailure {
  TraceStatus status = TraceStatus::completed;
  std::string message;
};

/// Computes the first point into state.origin.node, and what it settles: the settings, the frame's bridge
/// where the trace begins on a branch point, and what the result says of the start. `problem` gets the
/// settings. Returns why, where there is no first point. Cost: one spectrum, O(n^3).
std::optional<StartFailure> compute_start(const PointSolver& solver, const TraceOptions& options,
                                          PathProblem& problem, TraceState& state);

/// A first step that is rarely refused, in the traced parameter.
double first_step(const PathNode& node, const PathProblem& problem, const TraceOptions& options);

/// Orders the modes behind a first point on which eigenvalues meet (`meets`, per track). Returns the modes
/// that begin there.
std::vector<Birth> order_first_departure(const std::vector<bool>& meets, const PathFrame& frame,
                                         PathNode& node, ModeNumbers& numbers);

}  // namespace eigentrail
