// What may help where a step was refused, other than a shorter step: another coordinate along the path,
// another chart for the mode to blame, or a block of it with the modes that it would meet.
#pragma once

#include "continuation/path/path_frame.hpp"
#include "continuation/tracks/joining.hpp"

namespace eigentrail {

/// What a remedy changed; empty: nothing, and only a shorter step may help.
struct Remedy {
  Regroupings changes = {};
  /// Where the coordinate changed: length of the next step in the new one.
  std::optional<double> turned_step = {};
  bool tried_to_join = false;

  bool helps() const { return turned_step || changes.charts + changes.joined > 0; }
};

/// Looks for a remedy at `node`, where the refused step of length h begins; `step` is that step if its points
/// were solved, else null. Changes tracks of the node, or the frame. `may_join`: whether blocks may still be
/// joined at this node.
Remedy find_remedy(const PathProblem& problem, PathFrame& frame, const JoiningRules& rules,
                   const Verdict& verdict, double h, const Step* step, bool may_join, PathNode& node,
                   RunCounts& counts);

}  // namespace eigentrail
