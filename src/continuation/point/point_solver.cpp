#include "continuation/point/point_solver.hpp"

#include "core/matrix_series.hpp"

namespace eigentrail {
namespace {

/// A predicted p counts as the end of the range within at_end times the length of the range plus
/// at_end * share_of_end * |end|: a step to the end reaches it except for rounding. The second part is about
/// five units in the last place of the end. With larger values the trace may end early by that much, with
/// smaller ones it may take a last step of the length of rounding.
constexpr double at_end = 1e-14;
constexpr double share_of_end = 0.1;

}  // namespace

InvariantPair predicted_pair(const Track& track, double h) {
  InvariantPair pair;
  pair.chart = track.pair.chart;
  pair.part = track.pair.part;
  pair.is_real = track.pair.is_real;
  pair.Z = evaluate_series(track.series.Z, h);
  pair.Lambda = evaluate_series(track.series.Lambda, h);
  return pair;
}

TracksAt all_tracks(const PathNode& node) {
  TracksAt all{node, {}};
  for (const Track& track : node.tracks) all.tracks.push_back(&track);
  return all;
}

TracksAt one_track(const PathNode& node, std::size_t track) {
  return {node, {&node.tracks[track]}};
}

Prediction PointSolver::predict(const TracksAt& base, double h) const {
  const Path& path = base.node.path;
  const PathRange& range = frame_.range;
  Prediction prediction;
  prediction.p = evaluate_series(path.parameters, h)[problem_.traced];
  const double rounding = at_end * (range.length() + share_of_end * std::abs(range.to));
  if (!frame_.plane && std::abs(prediction.p - range.to) <= rounding) prediction.p = range.to;
  prediction.equilibrium = {evaluate_series(path.x, h), evaluate_series(path.lambda, h), true};
  prediction.plane = frame_.plane;
  const double coordinate =
      frame_.coordinate(prediction.equilibrium.x, prediction.equilibrium.lambda, prediction.p);
  if (frame_.bridge && frame_.bridge->covers(coordinate)) {
    // On a bridge the equilibrium is given by an interpolant and not solved for.
    prediction.known = frame_.path_on_bridge(coordinate, problem_.order + 1);
    prediction.p = prediction.known->parameters(problem_.traced, 0);
  }
  for (const Track* track : base.tracks) prediction.pairs.push_back(predicted_pair(*track, h));
  return prediction;
}

std::optional<SolvedPoint> PointSolver::solve(const Prediction& prediction,
                                              const Matrix& nearby_basis) const {
  PathPoint point = compute_point(problem_, prediction, nearby_basis, counts_);
  if (point.status != PointStatus::computed) return std::nullopt;
  std::optional<PathNode> node = differentiate_point(problem_, point, counts_);
  if (!node) return std::nullopt;
  return SolvedPoint{std::move(point), std::move(*node)};
}

std::optional<SolvedPoint> PointSolver::follow(const TracksAt& base, double h) const {
  return solve(predict(base, h), base.node.basis.T[0]);
}

PathPoint PointSolver::reduce(const PathNode& base, double h) const {
  const Prediction there = predict({base, {}}, h);
  return reduce_at(problem_, there.p, there.equilibrium, base.basis.T[0], counts_, there.plane);
}

}  // namespace eigentrail
