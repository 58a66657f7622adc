// Remedies for a rejected step other than a shorter step: another coordinate along the path, another chart
// for the track that is the reason, or a block of that track with modes that it meets nearby.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/tracks/joining.hpp"

namespace eigentrail {

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
