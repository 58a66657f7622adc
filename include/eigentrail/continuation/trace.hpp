// The trace: a predictor-corrector loop over the parameter, from the scene's starting equilibrium to the end
// of the range.
#pragma once

#include <functional>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

enum class TraceStatus {
  completed,
  no_equilibrium,   ///< at the start
  singular_pencil,  ///< at the start: every number is an eigenvalue
  no_modes,         ///< nothing to follow
  multiple_mode,    ///< a followed mode is not simple at the start
  step_too_small,   ///< stopped on the way; the reason is in the message
  too_many_nodes,
  stopped  ///< the observer asked to stop
};

/// Whether the trace produced points before it ended.
bool has_started(TraceStatus status);

/// Steps that were tried and not taken, by reason.
struct Rejections {
  int inaccurate = 0;  ///< dense-output error above the tolerance
  int no_equilibrium = 0;
  int mode_lost = 0;  ///< corrector did not converge
  int mismatch = 0;   ///< modal assurance and assignment disagree with the continuation
  int merged = 0;     ///< two tracks arrived at one eigenpair
  int total() const { return inaccurate + no_equilibrium + mode_lost + mismatch + merged; }
};

struct [[nodiscard]] TraceResult {
  TraceStatus status = TraceStatus::completed;
  std::string message;  ///< reason when not completed, in words
  int nodes = 0;
  int n_modes = 0;                 ///< followed
  int n_available = 0;             ///< finite modes at the start
  int n_infinite = 0;              ///< infinite eigenvalues at the start
  Eigen::Index n_independent = 0;  ///< size of the reduced pencil, n - rank A
  double reached = 0.0;            ///< last parameter value
  double s_ref = 0.0;
  Rejections rejections;
  RunCounts counts;
  double seconds = 0.0;
};

/// What is known when the first point stands.
struct TraceStart {
  double s_ref = 0.0;
  int n_available = 0;
};

/// Called during a trace, in this order: `started` once, then `node` for every point. `node` returns whether
/// to go on.
struct TraceObserver {
  std::function<void(const TraceStart&)> started = [](const TraceStart&) {};
  std::function<bool(const PathNode&)> node = [](const PathNode&) { return true; };
};

/// Follows the modes of `model` as `options` say. Numerical failures end in the result's status; the points
/// before them have been handed to the observer. Throws std::invalid_argument for options with faults
/// (find_faults).
TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis = BasisChoice::aligned);

}  // namespace eigentrail
