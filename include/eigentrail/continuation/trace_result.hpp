// The result of a trace, the data that it hands to its observer, its callbacks, and the checkpoints from
// which it can be resumed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/path_step.hpp"

namespace eigentrail {

/// How a trace ended.
enum class TraceStatus {
  completed,
  no_equilibrium,   ///< at the start
  singular_pencil,  ///< at the start: det P(s) = 0 for every s
  no_modes,         ///< nothing to follow
  multiple_mode,    ///< the modes at the start could not be separated or differentiated
  step_too_small,   ///< ended within the range; the message gives the reason
  no_branch,        ///< the path requested at a branch point was not found
  too_many_nodes,
  outside_band,  ///< no mode came into the band of frequencies that was asked for
  stopped        ///< the observer requested it
};

/// Numbers of rejected steps, by reason.
struct Rejections {
  int inaccurate = 0;  ///< dense-output error above the tolerance
  int no_equilibrium = 0;
  int mode_lost = 0;    ///< the corrector did not converge, or a series is not finite
  int mismatch = 0;     ///< the shape of a single mode changed too much (only without certificate)
  int merged = 0;       ///< two tracks converged to the same eigenpair
  int uncertified = 0;  ///< the certificate of a track failed
  int total() const { return inaccurate + no_equilibrium + mode_lost + mismatch + merged + uncertified; }
};

/// Numbers of changes in how modes and path are followed.
struct Regroupings {
  int joined = 0;    ///< blocks formed
  int parted = 0;    ///< tracks gained by separating blocks
  int charts = 0;    ///< changes between s and 1/s
  int repaired = 0;  ///< missing modes that were added
  int planes = 0;    ///< changes of the coordinate along the path
};

struct [[nodiscard]] TraceResult {
  TraceStatus status = TraceStatus::completed;
  std::string message;             ///< reason if not completed
  std::vector<std::string> notes;  ///< remarks for the user
  int nodes = 0;                   ///< number of points
  int n_modes = 0;                 ///< modes followed at the start
  int n_columns = 0;               ///< modes that were followed on any part of the range
  int n_available = 0;             ///< finite modes at the start
  int n_infinite = 0;              ///< infinite eigenvalues at the start
  Eigen::Index n_independent = 0;  ///< size of the reduced pencil, n - rank A
  int order = 0;                   ///< of the series at each point, as requested or chosen
  double reached = 0.0;            ///< last parameter value
  double s_ref = 0.0;              ///< magnitude below which an eigenvalue counts as zero, 1/s
  std::vector<Event> events;
  long mode_steps = 0;       ///< sum over all steps of the number of modes
  long certified_steps = 0;  ///< the same for the modes certified on the step
  Rejections rejections;
  Regroupings regroupings;
  RunCounts counts;
  double seconds = 0.0;
};

/// What is known after the first point has been computed; fields as in TraceResult.
struct TraceStart {
  double s_ref = 0.0;
  int n_available = 0;
  int n_modes = 0;  ///< modes may be added later, where complex pairs become two real modes
  int order = 0;
};

/// A mode at a point.
struct ModeState {
  int mode = 0;         ///< from 0
  Complex s;            ///< the eigenvalue with Im s >= 0
  Complex slope;        ///< ds/dp; NaN where eigenvalues coincide, infinite at a fold
  ComplexVector shape;  ///< physical coordinates
  double backward_error = 0.0, condition = 0.0;
  double rounding = 0.0;  ///< error of s by rounding of the entries of the matrices, 1/s
};

/// A point of the trace with the step that led to it.
struct TracePoint {
  const PathNode& node;
  std::vector<ModeState> modes;    ///< all modes that exist at the point
  const PathStep* step = nullptr;  ///< from the point before; null at the first point
  int growing_unfollowed = -1;     ///< number of growing modes that are not followed; -1: not known
};

/// The state of a trace between two points. All points so far have been handed to the observer.
class Checkpoint {
 public:
  virtual const TraceResult& so_far() const = 0;
  /// The state of the trace as bytes, for resume_trace. Only the same version of the program can read them.
  virtual std::string save() const = 0;

 protected:
  ~Checkpoint() = default;
};

/// Functions that a trace calls: `started` once, then `point` for every point, and `checkpoint` between two
/// points. The last two return whether the trace shall go on.
struct TraceObserver {
  std::function<void(const TraceStart&)> started = [](const TraceStart&) {};
  std::function<bool(const TracePoint&)> point = [](const TracePoint&) { return true; };
  std::function<bool(const Checkpoint&)> checkpoint = [](const Checkpoint&) { return true; };
};

}  // namespace eigentrail
