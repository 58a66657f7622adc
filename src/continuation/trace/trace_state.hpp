// The state of a trace: everything that changes from one point to the next. trace_archive.cpp saves it member
// by member.
#pragma once

#include "continuation/events/criteria_scan.hpp"
#include "continuation/path/other_path.hpp"
#include "continuation/step/certificate_retries.hpp"
#include "continuation/step/step_solver.hpp"
#include "continuation/tracks/ended_modes.hpp"
#include "continuation/tracks/mode_copies.hpp"
#include "continuation/tracks/mode_order.hpp"
#include "eigentrail/continuation/step_control.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// Which modes are followed, and how.
struct TraceSettings {
  bool follows_all = false;  ///< every finite mode is followed
  bool leaves_out = false;   ///< there are others beside the followed modes and permanent zeros
  bool joins_pairs = false;  ///< a mode came near the real axis: conjugate pairs of parts are real parts now
};

/// Branch points along the trace.
struct BranchPassage {
  std::size_t passed = 0;  ///< branch points so far
  int tries = 0;           ///< attempts to build a bridge from the last point
  /// The other path at the branch point that was reached last. Not saved, because it is used at once.
  std::optional<PathPlane> other = {};
};

/// What is remembered of the last steps.
struct StepMemory {
  int joins = 0;         ///< attempts to join blocks at the last point
  int ended = 0;         ///< tracks that ended at the last point
  int towards_pole = 0;  ///< points in a row on which the position grew towards a pole
  CertificateRetries retries = {};
  double longest_step = 0.0;  ///< of about the last ten steps, in the coordinate along the path
  double turned_step = 0.0;   ///< length of the next step if the coordinate has just changed, else 0
};

/// The point and mode of which rounding leaves least known.
struct LeastKnown {
  double error = 0.0;  ///< relative to max(|s|, reference)
  int mode = 0;
  double p = 0.0;
};

/// The whole state.
struct TraceState {
  TraceSettings settings = {};
  TraceResult result = {};
  StepControl control = {};
  StepOrigin origin = {};
  PathFrame frame = {};
  BranchPassage branches = {};
  ModeNumbers numbers = {};
  ModeCopies copies = {};
  CriterionHistories histories = {};
  std::vector<Event> events = {};  ///< of the tracks; the result has those of copies as well
  StepMemory steps = {};
  std::vector<EndedTrack> ended = {};  ///< tracks that are looked for
  LeastKnown least_known = {};
};

/// The problem of a trace: the model along the traced parameter with the values in the options. Order, route
/// and the magnitudes that count as zero and as infinite are determined at the first point.
PathProblem trace_problem(const Model& model, const TraceOptions& options, BasisChoice basis);

/// Distance in steps beyond which a meeting of two eigenvalues no longer keeps them in one block. The error
/// of the interpolant of order q decreases like (h / 2d)^(2q+2), where d is the distance of the nearest
/// meeting: only nearer meetings limit the step.
double parting_reach(const TraceOptions& options, int order);

/// Whether an eigenvalue of a complex part is near the real axis at a point, or below it.
bool is_near_real_axis(const PathProblem& problem, const PathNode& node);

/// Makes all conjugate pairs of the parts real parts. Returns the new index of every part.
std::vector<int> join_pairs(PathProblem& problem);

/// Follows all conjugate pairs as real parts, from the last point on.
void join_conjugate_parts(PathProblem& problem, TraceState& state);

/// The state as bytes, with their checksum, the sizes of the problem and what the first point determined of
/// it.
std::string save_state(const TraceState& state, const PathProblem& problem, const TraceOptions& options);
/// The state from such bytes; sets what the first point determined of the problem, and its parts. Throws
/// InputError if they are damaged, or of a problem with other sizes or other matrices at the last point.
TraceState restore_state(std::string_view bytes, PathProblem& problem, const TraceOptions& options);

}  // namespace eigentrail
