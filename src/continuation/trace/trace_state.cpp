#include "continuation/trace/trace_state.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/scene_parts.hpp"

namespace eigentrail {
namespace {

/// Relative error of every series coefficient of a single mode, as a share of the tolerance. The coefficient
/// of power k enters the dense output times h^k, k up to 4, and its error with it; the share leaves a wide
/// margin. A larger value may show in the dense output, a smaller one costs refinements.
constexpr double series_share = 1e-5;
/// Least such error: what rounding allows.
constexpr double series_rounding = 1e-15;
/// Factor in parting_reach. At a distance of 0.5 tolerance^(-1/(2q+2)) steps, a meeting allows single modes a
/// step of exactly the present length. 0.7 keeps a block together until single modes would allow steps 1.4
/// times as long. A larger value keeps blocks, which cost more, for longer; a smaller one separates blocks
/// that soon have to be joined again.
constexpr double parting_share = 0.7;

}  // namespace

PathProblem trace_problem(const Model& model, const TraceOptions& options, BasisChoice basis) {
  PathProblem problem = problem_along(model, options.parameter);
  for (const auto& [name, value] : options.values)
    problem.parameters[model.description().parameters.index(name).value()] = value;
  problem.basis = basis;
  if (basis == BasisChoice::aligned) problem.parts = parts_of_family(problem, options);
  problem.threads = options.threads;
  problem.thresholds = options.thresholds;
  problem.corrector.series_accuracy = std::max(series_share * options.tolerance, series_rounding);
  return problem;
}

double parting_reach(const TraceOptions& options, int order) {
  return parting_share * std::pow(options.tolerance, -1.0 / (2.0 * order + 2.0));
}

bool is_near_real_axis(const PathProblem& problem, const PathNode& node) {
  return std::any_of(node.tracks.begin(), node.tracks.end(), [&](const Track& track) {
    if (node.pencil.of(track.pair.part).complex_sign == 0) return false;
    return std::any_of(track.roots.begin(), track.roots.end(), [&](Complex root) {
      const Complex s = chart_value(root, track.pair.chart);
      return s.imag() <= 0.0 || is_near_real_axis(s, problem.s_ref);
    });
  });
}

std::vector<int> join_pairs(PathProblem& problem) {
  std::vector<int> numbers;
  problem.parts = joined_pairs(*problem.parts, std::vector<bool>(problem.parts->count(), true), numbers);
  return numbers;
}

void join_conjugate_parts(PathProblem& problem, TraceState& state) {
  const std::vector<int> numbers = join_pairs(problem);
  const auto renumber = [&numbers](Track& track) {
    track.pair.part = numbers[static_cast<std::size_t>(track.pair.part)];
    track.pair.factors.reset();  // of the complex part
  };
  PathNode& node = state.origin.node;
  node.basis.parts = problem.parts;
  node.pencil = reduce(node.linearization, node.basis, problem.order + 1);
  for (Track& track : node.tracks) renumber(track);
  for (EndedTrack& one : state.ended) renumber(one.track);
  state.settings.joins_pairs = true;
}

}  // namespace eigentrail
