// A step that passes a place where modes, or the path, must be known exactly on both sides is cut there: at
// the end of the range, at a fold, and at the first meeting of eigenvalues in one block.
#pragma once

#include "continuation/events/expected_meetings.hpp"
#include "continuation/step/step_solver.hpp"

namespace eigentrail {

/// A meeting on the end of a step.
struct MeetingOnEnd {
  std::size_t track = 0;
  Meeting meeting;
  int looks = 0;  ///< points computed to find it
};

/// A step that ends where it has to. It is judged anew when it is shorter than the one that was cut.
struct LandedStep {
  Step step;
  std::vector<MeetingOnEnd> meetings = {};
};

/// Cuts a step where it has to end. Empty where such a place is seen and not reached; a shorter step may
/// help. `on_any_terms`: a step so short that meetings which are not reached are passed over.
std::optional<LandedStep> land(StepSolver& solver, Step step, bool on_any_terms);

/// Meetings on a point, as at the start of a trace: of every two eigenvalues of every block.
std::vector<MeetingOnEnd> meetings_at(const PathProblem& problem, const PathFrame& frame,
                                      const PathNode& node);

}  // namespace eigentrail
