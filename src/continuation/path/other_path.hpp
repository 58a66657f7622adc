// The other equilibrium path at a branch point, and the choice of the path that the trace follows from there.
//
// Choice 1 is the trace's own path. The other path leaves the point in two directions, choices 2 and 3.
// Choice 2 is the direction in which the parameter moves towards the end of the range. At a pitchfork p
// changes alike in both; then it is the direction in which the coordinate that changes most increases. Points
// of the other path are computed on planes whose normal is the part of the kernel of [K f] that is orthogonal
// to the trace's own path. It gets a bridge of its own.
#pragma once

#include <string>

#include "continuation/path/branch_points.hpp"

namespace eigentrail {

/// The result of the search for the other path.
struct BranchSurvey {
  /// A plane across the other path, its coordinate growing in the direction of choice 2; empty where that
  /// path was not found.
  std::optional<PathPlane> other;
  std::string note;  ///< for the user: the choices in words
};

/// The choice (1 to 3) at a branch point, which are counted from 0. `wanted` lists the choices in order; a
/// single one holds for all branch points. After the end of the list the choice is 1.
int choice_at(const std::vector<int>& wanted, std::size_t branch_point);

/// Searches for the other path at the branch point `node`. `choice`, which the trace takes, and `where`, the
/// place in words, are for the note.
BranchSurvey survey_branch_point(const PointSolver& solver, const PathNode& node, int choice,
                                 const std::string& where);

/// A start on the other path: the branch point with the series of that path, and a frame with its bridge.
struct OtherStart {
  PathFrame frame;
  PathNode node;           ///< the modes of its tracks are not set yet
  double next_step = 0.0;  ///< length of the first step
};

/// Starts on the other path in the direction of `choice`, 2 or 3. Empty if the path is not found.
std::optional<OtherStart> start_on_other_path(const PointSolver& solver, const PathNode& node,
                                              const PathPlane& other, int choice);

}  // namespace eigentrail
