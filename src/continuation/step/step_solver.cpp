#include "continuation/step/step_solver.hpp"

#include <cmath>

#include "continuation/point/continued_mode.hpp"
#include "continuation/tracks/mode_order.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "core/parallel.hpp"
#include "eigentrail/continuation/point_modes.hpp"

namespace eigentrail {
namespace {

/// A mode may be accepted without correction only far from events, because the search for events needs
/// accurate eigenvalues: |Re s| must exceed this many times the error of its prediction, |s| this many times
/// the reference. A larger value corrects more modes, with a smaller one events are located from less
/// accurate series.
constexpr double far_from_axis = 100.0;
/// Likewise no meeting with another mode may be nearer than this many times the distance at which blocks are
/// separated (parting_reach).
constexpr double far_from_others = 2.0;

}  // namespace

bool StepSolver::is_far_from_events(const ContinuedMode& mode, std::size_t track, double h) const {
  const PathProblem& problem = solver_.problem();
  const Complex mu = mode.pair.Lambda(0, 0);
  const double error = problem.corrector.passing_error * std::abs(mu);
  return std::abs(mu.real()) > far_from_axis * error &&
         std::abs(mu) > far_from_axis * problem.reference(mode.pair.chart) &&
         find_partners(origin_.node, track, h, far_from_others * parting_reach_).empty();
}

void StepSolver::continue_modes(double h, Prediction& prediction) const {
  const PathProblem& problem = solver_.problem();
  // If all modes are corrected at once, skipping some of them saves nothing.
  if (problem.route != ModeRoute::one_by_one || solver_.frame().plane || origin_.last_step == 0.0) return;
  const std::size_t count = origin_.node.tracks.size();
  prediction.continued.resize(count);
  const int threads = is_worth_sharing(count, origin_.node.pencil.size()) ? problem.threads : 1;
  in_parallel(count, threads, [&](std::size_t i) {
    if (prediction.ready[i] != nullptr) return;
    prediction.continued[i] = continue_mode(origin_.previous, origin_.node, i, origin_.last_step, h);
  });
  prediction.may_pass = [this, h](const ContinuedMode& mode, std::size_t i) {
    return is_far_from_events(mode, i, h);
  };
}

Prediction StepSolver::predict(double h) {
  PathNode& node = origin_.node;
  for (Track& track : node.tracks) {
    if (track.lineage == 0) track.lineage = ++origin_.lineages;
  }
  Prediction prediction = solver_.predict(all_tracks(node), h);
  prediction.ready.assign(node.tracks.size(), nullptr);
  if (origin_.tried && origin_.tried->h == h) {
    for (std::size_t i = 0; i < node.tracks.size(); ++i) {
      for (const Track& other : origin_.tried->tracks) {
        if (other.lineage == node.tracks[i].lineage) prediction.ready[i] = &other;
      }
    }
  }
  continue_modes(h, prediction);
  return prediction;
}

StepSolver::Computed StepSolver::compute(double h) {
  const PathProblem& problem = solver_.problem();
  RunCounts& counts = solver_.counts();
  const Prediction prediction = predict(h);
  std::optional<TriedPoint>& tried = origin_.tried;
  if (tried && tried->h == h && tried->equations) {
    PathNode equations = std::move(*tried->equations);
    tried->equations.reset();
    Computed again{point_of(equations)};
    correct_modes(problem, prediction, again.point, counts);
    if (again.point.status == PointStatus::computed)
      again.node = differentiate_modes(problem, again.point, std::move(equations), counts);
    return again;
  }
  Computed computed{compute_point(problem, prediction, origin_.node.basis.T[0], counts)};
  if (computed.point.status == PointStatus::computed)
    computed.node = differentiate_point(problem, computed.point, counts);
  return computed;
}

AttemptedStep StepSolver::attempt(double h) {
  const PathNode& node = origin_.node;
  auto [point, next] = compute(h);
  if (point.status == PointStatus::no_equilibrium)
    return {{}, {Verdict::Kind::no_equilibrium, -1, INFINITY, point.message}};
  if (point.status == PointStatus::mode_lost)
    return {{}, {Verdict::Kind::mode_lost, point.lost_track, INFINITY, point.message}};
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
