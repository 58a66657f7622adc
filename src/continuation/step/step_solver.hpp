// Computation of the point at the end of a step. The prediction uses the last two points, and the tracks that
// an earlier attempt at the same step has computed already.
#pragma once

#include "continuation/point/point_solver.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// What an attempt computed that is repeated with other blocks.
struct TriedPoint {
  double h = 0.0;  ///< its signed distance from the begin of the step
  std::vector<Track> tracks = {};
  /// The series of its equations, without tracks: they do not depend on the blocks. Empty once they were
  /// used.
  std::optional<PathNode> equations = {};
};

/// The begin of the next step, with data of earlier ones. All members are saved with the state of a trace.
struct StepOrigin {
  PathNode node;                     ///< the last accepted point
  std::vector<Track> previous = {};  ///< at the point before it
  double last_step = 0.0;            ///< signed length between the two; 0: none in the present coordinate
  std::optional<TriedPoint> tried = {};
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
  /// Keeps references to solver and origin. `parting_reach` as in trace_state.hpp.
  StepSolver(const PointSolver& solver, StepOrigin& origin, double parting_reach)
      : solver_(solver), origin_(origin), parting_reach_(parting_reach) {}

  /// The step of signed length h from the origin, with the eigenvalues of its blocks in the order of the
  /// modes.
  AttemptedStep attempt(double h);

  const PointSolver& points() const { return solver_; }

 private:
  Prediction predict(double h);
  /// The point at a distance h, and the series there.
  struct Computed {
    PathPoint point;
    std::optional<PathNode> node = {};
  };
  Computed compute(double h);
  /// Adds the extrapolation of the last step's dense output as a second prediction of single modes.
  void continue_modes(double h, Prediction& prediction) const;
  /// Whether a mode may be accepted without correction.
  bool is_far_from_events(const ContinuedMode& mode, std::size_t track, double h) const;

  const PointSolver& solver_;
  StepOrigin& origin_;
  double parting_reach_;
};

}  // namespace eigentrail
