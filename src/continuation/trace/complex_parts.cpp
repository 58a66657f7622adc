#include "continuation/trace/complex_parts.hpp"

#include <algorithm>

#include "eigentrail/continuation/family_parts.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {

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
