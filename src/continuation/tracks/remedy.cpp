#include "continuation/tracks/remedy.hpp"

namespace eigentrail {
namespace {

/// In steps: a mode that is lost, exchanged or not certified is joined with the nearest mode that it meets
/// within this distance from the step. Close meetings let the corrector converge to the wrong mode; more
/// distant ones only reduce the accuracy.
constexpr double join_reach = 1.0;

}  // namespace

Remedy find_remedy(const PathProblem& problem, PathFrame& frame, const JoiningRules& rules,
                   const Verdict& verdict, double h, const Step* step, bool may_join, PathNode& node,
                   RunCounts& counts) {
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
  // What was lost or not certified among close eigenvalues is followed together with them.
  if (verdict.kind != Verdict::Kind::inaccurate) partners = crowding_partners(node, track, h);
  if (!partners.empty()) {
    // no need to look for a meeting
  } else if (verdict.kind == Verdict::Kind::inaccurate && step != nullptr) {
    partners = helpful_partners(problem, rules, *step, track, verdict.error,
                                find_partners(node, track, h, rules.parting_reach));
  } else {
    partners = find_partners(node, track, h, join_reach);
    if (partners.size() > 1) partners.resize(1);
  }
  remedy.tried_to_join = !partners.empty();
  if (remedy.tried_to_join && join(problem, node, track, partners, counts)) ++remedy.changes.joined;
  return remedy;
}

}  // namespace eigentrail
