#include "continuation/step/step_solver.hpp"

#include <cmath>

#include "continuation/tracks/mode_order.hpp"

namespace eigentrail {

AttemptedStep StepSolver::attempt(double h) {
  PathNode& node = origin_.node;
  for (Track& track : node.tracks) {
    if (track.lineage == 0) track.lineage = ++origin_.lineages;
  }
  const PathProblem& problem = solver_.problem();
  RunCounts& counts = solver_.counts();
  const PathPoint point =
      compute_point(problem, solver_.predict(all_tracks(node), h), node.basis.T[0], counts);
  if (point.status == PointStatus::no_equilibrium)
    return {{}, {Verdict::Kind::no_equilibrium, -1, INFINITY, point.message}};
  if (point.status == PointStatus::mode_lost)
    return {{}, {Verdict::Kind::mode_lost, point.lost_track, INFINITY, point.message}};
  std::optional<PathNode> next = differentiate_point(problem, point, counts);
  if (!next) return {{}, {Verdict::Kind::mode_lost, -1, INFINITY, "a series is not finite"}};
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    next->tracks[i].lineage = node.tracks[i].lineage;
    next->tracks[i].inseparable = node.tracks[i].inseparable;
    next->tracks[i].unproven = node.tracks[i].unproven;
  }
  AttemptedStep attempted{Step{&node, std::move(*next), h}, {}};
  order_arrival(*attempted.step);
  return attempted;
}

}  // namespace eigentrail
