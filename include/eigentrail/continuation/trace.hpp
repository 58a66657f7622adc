// The trace: a predictor-corrector loop along the path, from the scene's starting equilibrium to the end of
// the range.
#pragma once

#include <functional>
#include <string_view>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

enum class TraceStatus {
  completed,
  no_equilibrium,   ///< at the start
  singular_pencil,  ///< at the start: every number is an eigenvalue
  no_modes,         ///< nothing to follow
  multiple_mode,    ///< the modes at the start cannot be told apart
  step_too_small,   ///< stopped on the way; the reason is in the message
  no_branch,        ///< the path asked for at a branch point was not found
  too_many_nodes,
  stopped  ///< the observer asked to stop
};

/// Whether the trace produced points before it ended.
bool has_started(TraceStatus status);

/// Steps that were tried and not taken, by reason.
struct Rejections {
  int inaccurate = 0;  ///< dense-output error above the tolerance
  int no_equilibrium = 0;
  int mode_lost = 0;    ///< corrector did not converge
  int mismatch = 0;     ///< a single mode changed its shape too much (without certificate)
  int merged = 0;       ///< two tracks arrived at one eigenpair
  int uncertified = 0;  ///< the certificate did not close
  int total() const { return inaccurate + no_equilibrium + mode_lost + mismatch + merged + uncertified; }
};

/// Changes of what is followed together.
struct Regroupings {
  int joined = 0;
  int parted = 0;
  int charts = 0;    ///< changes between s and 1/s
  int repaired = 0;  ///< modes found missing and added
  int planes = 0;    ///< changes of the path's coordinate
};

struct [[nodiscard]] TraceResult {
  TraceStatus status = TraceStatus::completed;
  std::string message;             ///< reason when not completed, in words
  std::vector<std::string> notes;  ///< what the user should know, in words
  int nodes = 0;
  int n_modes = 0;                 ///< followed at the start
  int n_columns = 0;               ///< modes that existed somewhere
  int n_available = 0;             ///< finite modes at the start
  int n_infinite = 0;              ///< infinite eigenvalues at the start
  Eigen::Index n_independent = 0;  ///< size of the reduced pencil, n - rank A
  int order = 0;                   ///< of the series at each point: as asked for, or chosen
  double reached = 0.0;            ///< last parameter value
  double s_ref = 0.0;
  std::vector<Event> events;
  long mode_steps = 0;       ///< modes times steps
  long certified_steps = 0;  ///< those whose identity is certified
  Rejections rejections;
  Regroupings regroupings;
  RunCounts counts;
  double seconds = 0.0;
};

/// What is known when the first point stands.
struct TraceStart {
  double s_ref = 0.0;
  int n_available = 0;
  int n_modes = 0;  ///< followed from the start; more may be born
  int order = 0;    ///< of the series
};

/// A mode at a point.
struct ModeState {
  int mode = 0;         ///< from 0
  Complex s;            ///< Im s >= 0
  Complex slope;        ///< ds/dp; NaN where eigenvalues meet, infinite at a fold
  ComplexVector shape;  ///< physical coordinates
  double backward_error = 0.0, condition = 0.0;
};

/// A point of the trace with the step that led to it.
struct TracePoint {
  const PathNode& node;
  std::vector<ModeState> modes;    ///< those that exist at the point
  const PathStep* step = nullptr;  ///< from the point before; none at the first
};

/// What a trace can go on from: all points up to here have been handed to the observer.
class Checkpoint {
 public:
  virtual const TraceResult& so_far() const = 0;
  /// The state of the trace as bytes, for resume_trace. They belong to this version of the program.
  virtual std::string save() const = 0;

 protected:
  ~Checkpoint() = default;
};

/// Called during a trace, in this order: `started` once, then `point` for every point; `checkpoint` between
/// points. The latter two return whether to go on.
struct TraceObserver {
  std::function<void(const TraceStart&)> started = [](const TraceStart&) {};
  std::function<bool(const TracePoint&)> point = [](const TracePoint&) { return true; };
  std::function<bool(const Checkpoint&)> checkpoint = [](const Checkpoint&) { return true; };
};

/// Follows the modes of `model` as `options` say. Numerical failures end in the result's status; the points
/// before them have been handed to the observer. Throws std::invalid_argument for options with faults
/// (find_faults).
TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis = BasisChoice::aligned);

/// Goes on from a checkpoint of a trace of the same model with the same options: the points that follow, and
/// the result, are bit for bit those of the trace that was left; `started` is not called. Throws InputError
/// when the state is damaged or belongs to another model.
TraceResult resume_trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                         std::string_view state);

}  // namespace eigentrail
