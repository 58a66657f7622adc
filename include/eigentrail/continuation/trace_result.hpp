// What a trace returns, and what it hands out on its way.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_node.hpp"
#include "eigentrail/continuation/path_step.hpp"

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

}  // namespace eigentrail
