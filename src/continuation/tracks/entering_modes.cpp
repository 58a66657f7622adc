#include "continuation/tracks/entering_modes.hpp"

#include <algorithm>

#include "continuation/point/point_solver.hpp"
#include "continuation/tracks/completeness.hpp"
#include "continuation/tracks/guard_modes.hpp"
#include "continuation/tracks/members.hpp"
#include "continuation/tracks/starting_tracks.hpp"
#include "continuation/tracks/towards_infinity.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "modes/energy_stability.hpp"

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

/// Number of eigenvalues of a spectrum with Re s > 0; a complex pair counts once.
int growing_roots(const ComplexVector& roots) {
  return static_cast<int>((roots.real().array() > 0.0 && roots.imag().array() >= 0.0).count());
}

/// Makes guard modes of the modes of a track that are not needed: neither wanted, nor growing by more than
/// rounding. Returns whether any is.
template <class IsWanted>
bool dismiss_unneeded(const PathProblem& problem, const IsWanted& is_wanted, Track& track) {
  const Vector rounding = rounding_of_roots(track, problem.thresholds.rounding);
  bool any = false;
  for (Eigen::Index i = 0; i < track.size(); ++i) {
    int& mode = track.modes[static_cast<std::size_t>(i)];
    const bool grows = track.roots[i].real() > rounding[i];  // also of 1/s
    if (mode >= 0 && !grows && !is_wanted(chart_value(track.roots[i], track.pair.chart))) mode = Track::guard;
    any = any || mode >= 0;
  }
  return any;
}

/// An entering mode in a block with the mode that nobody follows and that it meets on a step of length h, or
/// near it; empty if there is none.
std::optional<Track> with_partner(const PathProblem& problem, const Track& entering_mode, double h,
                                  double reach, PathNode node, RunCounts& counts) {
  node.tracks.push_back(entering_mode);
  if (!join_unfollowed(problem, node, node.tracks.size() - 1, h, reach, counts)) return std::nullopt;
  return std::move(node.tracks.back());
}

/// An entering mode at the left end of the step of length h behind which it was noticed; empty if it is not
/// recognized there, or followed already.
std::optional<Track> at_left_end(const PathProblem& problem, const Track& entering_mode, double h,
                                 const PathNode& left, RunCounts& counts) {
  auto track = recognize(problem, left, predicted_pair(entering_mode, -h), counts);
  if (!track) return std::nullopt;
  const ComplexVector expected = block_roots(evaluate_series(entering_mode.functions, -h));
  track->modes = entering_mode.modes;
  track->roots = in_order_of(in_order_of(entering_mode.roots, expected), track->roots);
  return track;
}

}  // namespace

EnteringModes entering_modes(const PathProblem& problem, const ModeChoice& choice, const PathNode& node,
                             RunCounts& counts) {
  const bool is_whole = problem.model.projection() == nullptr;
  if (!is_whole && !choice.may_grow()) return {};
  const StageTimer timer(counts.matching_seconds);
  const bool may_grow = is_whole && !is_stable_by_energy(node.pencil, problem.structure);
  if (!choice.may_grow() && !may_grow) return {{}, 0};
  const Spectrum spectrum = compute_eigenvalues(node.pencil);
  ++counts.spectra;
  if (spectrum.status != SpectrumStatus::complete) return {};
  const auto is_wanted = [&](Complex s) { return choice.may_grow() && choice.wants(s); };
  std::vector<StartingMode> others =
      missing_modes(node, spectrum, problem.s_ref, problem.thresholds.rounding);
  const auto needed_end = std::stable_partition(others.begin(), others.end(), [&](const StartingMode& mode) {
    return (is_wanted(mode.s) || (may_grow && mode.s.real() > 0.0)) && has_arrived(problem, node, mode.s);
  });
  EnteringModes found{{}, is_whole ? 0 : -1};
  for (const StartingGroup& group :
       starting_groups(node.pencil, others, static_cast<int>(needed_end - others.begin()), problem.s_ref)) {
    std::optional<Track> track = track_of(problem, node, group, counts);
    if (!track) {
      if (may_grow) found.growing += growing_roots(group.roots);
      continue;
    }
    if (is_followed(problem, node, *track)) continue;
    if (dismiss_unneeded(problem, is_wanted, *track)) found.tracks.push_back(std::move(*track));
  }
  return found;
}

int follow_back(const PathProblem& problem, const std::vector<Track>& entering_modes, double h,
                const PathNode& right, double reach, PathNode& left, ModeNumbers& numbers,
                RunCounts& counts) {
  int added = 0;
  for (const Track& entering_mode : entering_modes) {
    auto track = at_left_end(problem, entering_mode, h, left, counts);
    if (!track) {
      if (const auto block = with_partner(problem, entering_mode, -h, reach, right, counts))
        track = at_left_end(problem, *block, h, left, counts);
    }
    if (track) added += add(std::move(*track), left, numbers);
  }
  return added;
}

int number_growing_guards(const PathProblem& problem, const PathNode& right, PathNode& left,
                          ModeNumbers& numbers) {
  int found = 0;
  for (std::size_t t = 0; t < right.tracks.size(); ++t) {
    const Track& end = right.tracks[t];
    std::vector<int>& modes = left.tracks[t].modes;
    if (!contains(modes, Track::guard)) continue;
    const Vector rounding = rounding_of_roots(end, problem.thresholds.rounding);
    for (Eigen::Index i = 0; i < end.size(); ++i) {
      int& mode = modes[static_cast<std::size_t>(i)];
      // Of a pair in a real block the member with Im s > 0 has the number.
      const bool is_conjugate = end.pair.is_real && is_lower(end.roots[i], end.pair.chart);
      if (mode != Track::guard || is_conjugate || !(end.roots[i].real() > rounding[i])) continue;
      mode = numbers.count++;
      ++found;
      const Eigen::Index partner = end.pair.is_real ? conjugate_of(end.roots, i) : i;
      if (partner != i) modes[static_cast<std::size_t>(partner)] = Track::no_mode;
    }
  }
  return found;
}

int begin_here(const PathProblem& problem, std::vector<Track> entering_modes, PathNode& node,
               ModeNumbers& numbers) {
  int added = 0;
  for (Track& entering_mode : entering_modes) {
    if (!is_followed(problem, node, entering_mode)) added += add(std::move(entering_mode), node, numbers);
  }
  return added;
}

}  // namespace eigentrail
