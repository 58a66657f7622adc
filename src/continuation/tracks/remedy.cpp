#include "continuation/tracks/remedy.hpp"

#include <cmath>

#include "continuation/step/step_error.hpp"
#include "continuation/tracks/guard_modes.hpp"

namespace eigentrail {
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
