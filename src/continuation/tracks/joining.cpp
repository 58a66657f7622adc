#include "continuation/tracks/joining.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/step/step_error.hpp"
#include "continuation/tracks/grouping_errors.hpp"
#include "continuation/tracks/guard_modes.hpp"

namespace eigentrail {
namespace {

// These values affect the time of a trace, not its results: a block of k modes costs about k times as much as
// its modes one by one, but allows longer steps. They come from benchmarks of parameter sweeps.

/// Largest error of a block, as a share of that of the single mode, at which the block is worth its cost.
/// With order 3 the step grows with the eighth root of the error, 1 / 0.05^(1/8) = 1.45 times.
constexpr double worthwhile = 0.05;
/// Single modes with at least this share of the accepted error limit the step.
constexpr double limiting_error = 0.1;
/// As `worthwhile`, for the change to the other chart, which has no extra cost.
constexpr double better_chart = 0.3;
/// Blocks of more than six are formed only if the step is shorter than this share of the longest one of the
/// last steps: at exceptional points of a higher order steps shrink towards zero. Blocks of more than two, to
/// six, only if it has shrunk at all. In large blocks the eigenvalues are harder to identify, and more events
/// are close to each other.
constexpr double much_shrinking = 0.1;
/// Meetings farther away than this many times the distance of the nearest one have little influence on the
/// error.
constexpr double as_near = 1.5;
constexpr Eigen::Index most_together = 16;

/// Whether a track of the right end is the same one at the left end: it was not added, or taken apart, at the
/// right end.
bool is_on_whole_step(const Step& step, std::size_t track) {
  const std::vector<Track>&left = step.left->tracks, &right = step.right.tracks;
  return track < left.size() && track < right.size() && left[track].lineage == right[track].lineage &&
         left[track].size() == right[track].size();
}

/// A track to be joined, with its partners. All choices are made before the first tracks are joined. Since
/// joining changes the indices of the tracks, they are identified by their lineages.
struct Choice {
  std::uint64_t lineage = 0;
  std::vector<Partner> partners;
  std::vector<std::uint64_t> partner_lineages;
};

/// Index of the track with that lineage; the number of tracks if there is none.
std::size_t index_of(const PathNode& node, std::uint64_t lineage) {
  const auto found = std::find_if(node.tracks.begin(), node.tracks.end(),
                                  [&](const Track& track) { return track.lineage == lineage; });
  return static_cast<std::size_t>(found - node.tracks.begin());
}

/// Joins the tracks of a choice. False if one of them no longer exists or the block cannot be formed.
bool join_choice(const PathProblem& problem, Choice& choice, PathNode& node, RunCounts& counts) {
  const std::size_t track = index_of(node, choice.lineage);
  bool all_there = choice.lineage != 0 && track < node.tracks.size();
  for (std::size_t i = 0; i < choice.partners.size(); ++i) {
    choice.partners[i].track = index_of(node, choice.partner_lineages[i]);
    all_there = all_there && choice.partners[i].track < node.tracks.size();
  }
  return all_there && join(problem, node, track, choice.partners, counts);
}

}  // namespace

std::vector<Partner> helpful_partners(const PathProblem& problem, const JoiningRules& rules, const Step& step,
                                      std::size_t track, double error,
                                      const std::vector<Partner>& candidates) {
  const std::vector<Track>& tracks = step.right.tracks;
  const Track& there = tracks[track];
  const double scale = std::max(there.roots.cwiseAbs().mean(), problem.reference(there.pair.chart));
  const double accepted = accepted_share * rules.tolerance * scale;
  const double length = std::abs(step.h);
  const Eigen::Index largest = length < much_shrinking * rules.longest_step ? most_together
                               : rules.has_shrunk(length)                   ? 6
                                                                            : 2;
  std::vector<Partner> chosen;
  Eigen::Index size = distinct_eigenvalues(there);
  for (const Partner& candidate : candidates) {
    if (!is_on_whole_step(step, candidate.track)) break;
    size += distinct_eigenvalues(tracks[candidate.track]);
    if (size > largest) break;
    if (candidate.distance > as_near * candidates.front().distance) break;
    chosen.push_back(candidate);
    const double together =
        error_as_block(*step.left, step.right, track, chosen, step.h, least_relative_gap * scale);
    if (together <= worthwhile * error * accepted) return chosen;
  }
  return {};
}

Regroupings regroup_limiting_modes(const PathProblem& problem, const JoiningRules& rules, Step& step,
                                   double next_step, RunCounts& counts) {
  Regroupings done;
  std::vector<Choice> choices;
  std::vector<Track>& tracks = step.right.tracks;
  const bool may_look_beyond = !rules.follows_all && rules.has_shrunk(next_step);
  std::size_t worst = tracks.size();
  double largest = limiting_error;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!is_on_whole_step(step, i)) continue;  // it has no error on the step
    // Blocks of different eigenvalues have been joined already; one of equal parts counts as a single mode.
    // With one that nobody follows a mode may have been joined for nothing.
    const bool is_joined = distinct_eigenvalues(tracks[i]) > 1;
    if (is_joined && !may_look_beyond) continue;
    const double error = track_error(problem, rules.tolerance, 0.0, step, i);
    if (error < limiting_error) continue;
    if (error >= largest) {
      largest = error;
      worst = i;
    }
    const double in_other_chart =
        is_joined ? INFINITY : error_in_other_chart(problem, *step.left, step.right, i, step.h);
    if (in_other_chart < better_chart * error * accepted_share * rules.tolerance) {
      if (change_chart(problem, step.right, i, counts)) ++done.charts;
      return done;
    }
    Choice choice{tracks[i].lineage, {}, {}};
    choice.partners = helpful_partners(problem, rules, step, i, error,
                                       limiting_partners(step.right, i, next_step, rules.parting_reach));
    for (const Partner& partner : choice.partners)
      choice.partner_lineages.push_back(tracks[partner.track].lineage);
    if (!choice.partners.empty()) choices.push_back(std::move(choice));
  }
  for (Choice& choice : choices) {
    if (join_choice(problem, choice, step.right, counts)) ++done.joined;
  }
  if (may_look_beyond && choices.empty() && worst < tracks.size() &&
      join_unfollowed(problem, step.right, worst, next_step, rules.parting_reach, counts))
    ++done.joined;
  return done;
}

}  // namespace eigentrail
