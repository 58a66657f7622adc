// Landing: a step that passes the end of the range, a fold, or a meeting of eigenvalues of one block
// (meetings.hpp) is shortened so that it ends there. Then the path and the modes are known on both sides.
#pragma once

#include "continuation/events/expected_meetings.hpp"
#include "continuation/step/step_solver.hpp"

namespace eigentrail {

/// A meeting at the right end of a step.
struct MeetingOnEnd {
  std::size_t track = 0;
  Meeting meeting;
  int looks = 0;  ///< points computed to locate it
};

/// The step after landing. If it was shortened, it must be judged again.
struct LandedStep {
  Step step;
  std::vector<MeetingOnEnd> meetings = {};
};

/// Shortens a step to the first such place that it passes. Empty if a predicted place cannot be located, or
/// if a block has more real eigenvalues at one end than at the other although none was found; a shorter step
/// may help. `on_any_terms`: the step cannot become shorter, and meetings that cannot be located are ignored.
std::optional<LandedStep> land(StepSolver& solver, Step step, bool on_any_terms);

/// The meetings of any two eigenvalues of a block at a point. For the start of a trace, where no step leads
/// to the point.
std::vector<MeetingOnEnd> meetings_at(const PathProblem& problem, const PathFrame& frame,
                                      const PathNode& node);

}  // namespace eigentrail
