#include "continuation/tracks/newcomers.hpp"
#include "continuation/tracks/arrival.hpp"

#include <algorithm>

#include "continuation/point/point_solver.hpp"
#include "continuation/tracks/completeness.hpp"
#include "continuation/tracks/recognition.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/continuation/point_modes.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Gives numbers to the wanted modes of a track, and adds it to a point. Returns their number.
int add(Track track, PathNode& node, ModeNumbers& numbers) {
  int added = 0;
  for (int& mode : track.modes) {
    if (mode < 0) continue;
    mode = numbers.count++;
    ++added;
  }
  track.arriving = track.modes;
  node.tracks.push_back(std::move(track));
  return added;
}

/// A newcomer at the left end of the step of length h behind which it was noticed; empty if it is not
/// recognized there, or followed already.
std::optional<Track> at_left_end(const PathProblem& problem, const Track& newcomer, double h,
                                 const PathNode& left, RunCounts& counts) {
  auto track = recognize(problem, left, predicted_pair(newcomer, -h), counts);
  if (!track) return std::nullopt;
  const ComplexVector expected = block_roots(evaluate_series(newcomer.functions, -h));
  track->modes = newcomer.modes;
  track->roots = in_order_of(in_order_of(newcomer.roots, expected), track->roots);
  return track;
}

}  // namespace

std::vector<Track> newcomers(const PathProblem& problem, const ModeChoice& choice, const PathNode& node,
                             RunCounts& counts) {
  if (!choice.may_grow()) return {};
  const bool meeting = std::any_of(node.tracks.begin(), node.tracks.end(),
                                   [](const Track& track) { return track.departure.has_value(); });
  if (meeting) return {};
  const StageTimer timer(counts.matching_seconds);
  const Spectrum spectrum = compute_eigenvalues(node.pencil);
  ++counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return {};
  std::vector<StartingMode> others = missing_modes(node, spectrum, problem.s_ref);
  const auto wanted_end = std::stable_partition(others.begin(), others.end(), [&](const StartingMode& mode) {
    return choice.wants(mode.s) && has_arrived(problem, node, mode.s);
  });
  std::vector<Track> found;
  for (const StartingGroup& group :
       starting_groups(node.pencil, others, static_cast<int>(wanted_end - others.begin()), problem.s_ref)) {
    InvariantPair pair = correct_pair(PencilAtPoint(node.pencil.of(group.pair.part)), group.pair,
                                      problem.s_ref, problem.corrector, counts.modes);
    if (pair.status != PairStatus::converged) continue;
    Track track = differentiate_track(problem, node, std::move(pair), counts);
    if (!track.functions.allFinite() || is_followed(problem, node, track)) continue;
    track.roots = in_order_of(group.roots, track.roots);
    track.modes = group.modes;
    found.push_back(std::move(track));
  }
  return found;
}

int follow_back(const PathProblem& problem, const std::vector<Track>& newcomers, double h, PathNode& left,
                ModeNumbers& numbers, RunCounts& counts) {
  int added = 0;
  for (const Track& newcomer : newcomers) {
    if (auto track = at_left_end(problem, newcomer, h, left, counts))
      added += add(std::move(*track), left, numbers);
  }
  return added;
}

int begin_here(const PathProblem& problem, std::vector<Track> newcomers, PathNode& node,
               ModeNumbers& numbers) {
  int added = 0;
  for (Track& newcomer : newcomers) {
    if (!is_followed(problem, node, newcomer)) added += add(std::move(newcomer), node, numbers);
  }
  return added;
}

}  // namespace eigentrail
