#include "continuation/tracks/joining.hpp"

#include <algorithm>

#include "continuation/step/step_error.hpp"
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

namespace {

/// In steps: a mode that is lost, exchanged or not certified is joined with the nearest mode that it meets
/// within this distance from the step. Close meetings let the corrector converge to the wrong mode; more
/// distant ones only reduce the accuracy.
constexpr double join_reach = 1.0;

/// Largest block that is formed for this reason if only some modes are followed. Large blocks take long
/// steps, on which meetings of their members may be passed; with all modes followed, a checksum notices what
/// is lost.
constexpr Eigen::Index most_of_few = 4;

/// Largest block that is formed where rounding hides its members: nothing smaller can be followed there.
constexpr Eigen::Index largest_where_hidden = 40;

/// Of two tracks on their way to infinity, whether one is so much closer to it that nothing but infinity
/// itself can keep it from being certified: a tenth of |1/s|, so that they part further on any step to it.
bool one_is_at_infinity(const Track& a, const Track& b) {
  constexpr double much_closer = 0.1;
  if (a.pair.chart != Chart::reciprocal) return false;
  const Vector of_a = a.roots.cwiseAbs(), of_b = b.roots.cwiseAbs();
  return of_a.maxCoeff() < much_closer * of_b.minCoeff() || of_b.maxCoeff() < much_closer * of_a.minCoeff();
}

/// The nearest other track, if a block with it may be formed.
std::optional<Partner> nearest_to_join(const JoiningRules& rules, const PathNode& node, std::size_t track) {
  const std::optional<Partner> nearest = nearest_partner(node, track);
  if (!nearest || one_is_at_infinity(node.tracks[track], node.tracks[nearest->track])) return std::nullopt;
  const Eigen::Index size = node.tracks[track].size() + node.tracks[nearest->track].size();
  if (!rules.follows_all && size > most_of_few) return std::nullopt;
  return nearest;
}

/// Joins a track that is not certified with the nearest other one. A block for which this was done before,
/// without effect, is not made larger.
bool join_unproven(const PathProblem& problem, const JoiningRules& rules, PathNode& node, std::size_t track,
                   RunCounts& counts) {
  if (node.tracks[track].unproven) return false;
  const std::optional<Partner> nearest = nearest_to_join(rules, node, track);
  if (!nearest || node.tracks[nearest->track].unproven) return false;
  if (!join_and_keep(problem, node, track, *nearest, counts)) return false;
  node.tracks.back().unproven = true;
  return true;
}

/// Whether rounding keeps a block from being accurate, or certified, on any step: it is of three or more,
/// steps have become short, and shorter ones would not help, since the terms of its series vanish already.
/// Then it is a part of a larger one, with vectors that are nearly parallel to those of the rest.
bool are_hidden_by_rounding(const PathProblem& problem, const JoiningRules& rules, const Verdict& verdict,
                            double h, const Step* step, const Track& track) {
  if (track.size() < 3 || !rules.has_shrunk(h)) return false;
  if (verdict.kind == Verdict::Kind::uncertified) return true;
  return verdict.kind == Verdict::Kind::inaccurate && step != nullptr &&
         series_are_exact(problem, rules.tolerance, *step, static_cast<std::size_t>(verdict.track));
}

}  // namespace

Remedy find_remedy(const PathProblem& problem, PathFrame& frame, const JoiningRules& rules,
                   const Verdict& verdict, double h, const Step* step, bool may_join, Shorter shorter,
                   PathNode& node, RunCounts& counts) {
  Remedy remedy;
  remedy.turned_step = turn_to_plane(problem, frame, node, h);
  if (remedy.turned_step) ++remedy.changes.planes;
  if (remedy.turned_step || verdict.kind == Verdict::Kind::no_equilibrium || verdict.track < 0) return remedy;
  const auto track = static_cast<std::size_t>(verdict.track);
  if (prefers_other_chart(node.tracks[track], h) && change_chart(problem, node, track, counts)) {
    ++remedy.changes.charts;
    return remedy;
  }
  if (!may_join) return remedy;
  std::vector<Partner> partners;
  if (verdict.kind == Verdict::Kind::inaccurate && step != nullptr) {
    partners = helpful_partners(problem, rules, *step, track, verdict.error,
                                limiting_partners(node, track, h, rules.parting_reach));
  } else {
    partners = find_partners(node, track, h, join_reach);
    if (partners.size() > 1) partners.resize(1);
  }
  const auto note = [&remedy](bool joined) {
    remedy.tried_to_join = true;
    if (joined) ++remedy.changes.joined;
  };
  if (!partners.empty()) {
    note(join(problem, node, track, partners, counts));
    return remedy;
  }
  const bool uncertified = verdict.kind == Verdict::Kind::uncertified;
  if (!rules.follows_all && (uncertified ? shorter == Shorter::in_vain : rules.has_shrunk(h)))
    note(join_unfollowed(problem, node, track, h, rules.parting_reach, counts));
  if (!remedy.helps() && are_hidden_by_rounding(problem, rules, verdict, h, step, node.tracks[track])) {
    const std::optional<Partner> nearest = nearest_to_join(rules, node, track);
    note(nearest && join_and_keep(problem, node, track, *nearest, counts, largest_where_hidden));
  }
  if (!remedy.helps() && uncertified && shorter == Shorter::in_vain)
    note(join_unproven(problem, rules, node, track, counts));
  // What was kept together cannot be followed together: the next point may take it apart.
  if (!remedy.helps()) node.tracks[track].inseparable = 0.0;
  return remedy;
}

}  // namespace eigentrail
