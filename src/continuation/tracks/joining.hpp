// Decides which modes are followed as one block: those whose exceptional points limit the accuracy of their
// series. Remedies for a rejected step other than a shorter step: another coordinate along the path, another
// chart for the track that is the reason, or a block of that track with modes that it meets nearby.
#pragma once

#include <cmath>

#include "continuation/path/path_frame.hpp"
#include "continuation/step/step.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "eigentrail/continuation/trace_result.hpp"

namespace eigentrail {

/// Data of the trace on which joining depends.
struct JoiningRules {
  double tolerance = 1e-6;     ///< of the trace
  double parting_reach = 3.0;  ///< in steps: meetings within this distance keep a block together
  double longest_step = 0.0;   ///< of about the last ten steps, in the coordinate along the path
  bool follows_all = true;     ///< every finite mode is followed

  /// Whether a step is so much shorter than the last ones that something nearby must be the reason: then
  /// larger blocks are worth their cost, and a look for modes that are not followed, which takes a large
  /// factorization.
  bool has_shrunk(double h) const {
    constexpr double share = 0.25;
    return std::abs(h) < share * longest_step;
  }
};

/// The partners with which a block reduces the error of a track so much that it is worth its cost: the
/// nearest candidate and, if that is not enough, the next ones. Empty if no such block does. `error`: error
/// of the track on the step, divided by the accepted one. `candidates`: by ascending distance, as from
/// limiting_partners.
std::vector<Partner> helpful_partners(const PathProblem& problem, const JoiningRules& rules, const Step& step,
                                      std::size_t track, double error,
                                      const std::vector<Partner>& candidates);

/// At the end of a step, joins single modes whose errors limit the length of the steps with the partners that
/// help, or, where steps have become short, with one that is not followed. If one of them is much more
/// accurate in the other chart, changes only that chart. Returns the numbers of changes. `next_step`: signed
/// length of the next step.
Regroupings regroup_limiting_modes(const PathProblem& problem, const JoiningRules& rules, Step& step,
                                   double next_step, RunCounts& counts);

/// What was changed. If nothing was (`helps` is false), only a shorter step can help.
struct Remedy {
  Regroupings changes = {};
  /// If the coordinate was changed: length of the next step in the new one.
  std::optional<double> turned_step = {};
  bool tried_to_join = false;  ///< whether partners for a block were found, joined or not

  bool helps() const { return turned_step || changes.charts + changes.joined > 0; }
};

/// Whether shorter steps have been found to help where a certificate fails.
enum class Shorter { may_help, in_vain };

/// Applies the first possible remedy at `node`, where the rejected step of signed length h begins, and
/// changes tracks of the node or the frame. `verdict`: why the step was rejected. `step`: the rejected step
/// if its right end was computed, else null. `may_join`: whether blocks may be formed at this node.
/// `shorter`: if in vain, a track that is not certified is joined with the nearest one, and both stay
/// together as long as they are about as close.
Remedy find_remedy(const PathProblem& problem, PathFrame& frame, const JoiningRules& rules,
                   const Verdict& verdict, double h, const Step* step, bool may_join, Shorter shorter,
                   PathNode& node, RunCounts& counts);

}  // namespace eigentrail
