// The point at the end of a step: predicted from the last two points and from what earlier attempts at the
// same step left, then solved.
#pragma once

#include "continuation/point/point_solver.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// Where the next step begins. All of it is saved with a trace.
struct StepOrigin {
  PathNode node;                       ///< the last accepted point
  PathNode previous = {};              ///< the one before it
  double last_step = 0.0;              ///< between the two; 0: there is none in the present coordinate
  std::optional<PathNode> tried = {};  ///< what an attempt with other blocks found ...
  double tried_step = 0.0;             ///< ... at this distance
  std::uint64_t lineages = 0;          ///< numbers given to tracks so far
};

/// A step that was computed, or why there is none.
struct AttemptedStep {
  std::optional<Step> step;
  Verdict verdict;  ///< accepted when there is a step; it has not been judged yet
};

class StepSolver {
 public:
  /// Refers to all of its arguments. `parting_reach` as in regrouping.hpp.
  StepSolver(const PointSolver& solver, StepOrigin& origin, double parting_reach)
      : solver_(solver), origin_(origin), parting_reach_(parting_reach) {}

  /// The step of length h from the origin, its eigenvalues ordered by mode.
  AttemptedStep attempt(double h);

  const PointSolver& points() const { return solver_; }

 private:
  Prediction predict(double h);
  /// Modes whose dense output of the last step goes on well enough may pass without correction.
  void continue_modes(double h, Prediction& prediction) const;
  bool is_far_from_events(const ContinuedMode& mode, std::size_t track, double h) const;

  const PointSolver& solver_;
  StepOrigin& origin_;
  double parting_reach_;
};

}  // namespace eigentrail
