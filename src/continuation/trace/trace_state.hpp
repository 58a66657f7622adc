// The state of a trace: all that changes from one point to the next, in one aggregate. The lists of what is
// saved (trace_archive.cpp) take it apart member by member.
#pragma once

#include "continuation/events/criteria_scan.hpp"
#include "continuation/path/other_path.hpp"
#include "continuation/step/step_solver.hpp"
#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/continuation/step_control.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// What the first point settles for the whole trace.
struct TraceSettings {
  int order = 3;
  double s_ref = 1.0, s_max = 1e300;
  ModeRoute route = ModeRoute::one_by_one;
  bool follows_all = false;
};

/// Branch points on the way.
struct BranchPassage {
  std::size_t passed = 0;  ///< branch points so far
  int tries = 0;           ///< bridges looked for from the last point
  std::optional<OtherPath> other =
      {};  ///< at the branch point that was reached last; not saved: it is used at once
};

/// How the steps went of late.
struct StepMemory {
  int joins = 0;              ///< blocks that were tried at the last point
  double longest_step = 0.0;  ///< of late, in the coordinate along the path
  double turned_step = 0.0;   ///< next step in a coordinate that has just changed; 0: it has not
};

struct TraceState {
  TraceSettings settings = {};
  TraceResult result = {};
  StepControl control = {};
  StepOrigin origin = {};
  PathFrame frame = {};
  BranchPassage branches = {};
  ModeNumbers numbers = {};
  CriterionHistories histories = {};
  std::vector<Event> dismissed = {};  ///< places of veerings that are none
  StepMemory steps = {};
};

/// The problem of a trace: the model along the traced parameter, with what the options say of it. Settings
/// are applied when they are known.
PathProblem trace_problem(const Model& model, const TraceOptions& options, BasisChoice basis);
void apply(const TraceSettings& settings, PathProblem& problem);

/// Blocks part when their meetings are farther away than this many steps. The interpolant of order q
/// converges like (h / 2d)^(2q+2) where the nearest meeting is at distance d: nearer ones limit the step.
double parting_reach(const TraceOptions& options, int order);

/// The state as bytes, and back. Throws InputError when the bytes are no state of a trace of this problem.
std::string save_state(const TraceState& state);
TraceState restore_state(std::string_view bytes, const PathProblem& problem, const TraceOptions& options);

}  // namespace eigentrail
