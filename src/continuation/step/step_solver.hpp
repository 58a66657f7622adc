// Computation of the point at the end of a step.
#pragma once

#include "continuation/point/point_solver.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The begin of the next step. All members are saved with the state of a trace.
struct StepOrigin {
  PathNode node;               ///< the last accepted point
  std::uint64_t lineages = 0;  ///< largest number given to a track so far
};

/// A computed step, or the reason why there is none.
struct AttemptedStep {
  std::optional<Step> step;
  Verdict verdict;  ///< accepted if there is a step; the step has not been judged yet
};

/// Computes steps from an origin.
class StepSolver {
 public:
  /// Keeps references to both.
  StepSolver(const PointSolver& solver, StepOrigin& origin) : solver_(solver), origin_(origin) {}

  /// The step of signed length h from the origin, with the eigenvalues of its blocks in the order of the
  /// modes.
  AttemptedStep attempt(double h);

  const PointSolver& points() const { return solver_; }

 private:
  const PointSolver& solver_;
  StepOrigin& origin_;
};

}  // namespace eigentrail
