// The other equilibrium path at a branch point, and the choice which one the trace goes on along.
//
// Choice 1 is straight on. The other path leaves the point in two directions, choices 2 and 3: first the one
// on which the parameter heads for the end of the range, or, where both do so alike (a pitchfork), the one
// on which the coordinate that moves most rises. The other path is met on planes across the part of the
// kernel of [K f] that the trace's own path does not have, and gets a bridge of its own.
#pragma once

#include <string>

#include "continuation/path/branch_points.hpp"

namespace eigentrail {

/// A plane across the other path, and the sign on it of choice 2.
struct OtherPath {
  PathPlane plane;
  double direction = 1.0;
};

/// What there is to choose from at a branch point.
struct BranchSurvey {
  std::optional<OtherPath> other;  ///< empty where the other path was not found
  std::string note;                ///< in words, for the user
};

/// The choice (1 to 3) for the branch point of that number, from 0: `wanted` lists them in order; a single
/// one holds for all, and 1 follows the last.
int choice_at(const std::vector<int>& wanted, std::size_t branch_point);

/// Looks where the other path leads from the branch point `node`. `choice` is what the trace takes; `where`
/// names the place.
BranchSurvey survey_branch_point(const PointSolver& solver, const PathNode& node, int choice,
                                 const std::string& where);

/// A start on the other path: the point itself in its coordinate, with a bridge ahead.
struct OtherStart {
  PathFrame frame;
  PathNode node;           ///< the modes of its tracks are still to be set
  double next_step = 0.0;  ///< length of the first step
};

/// Nothing where the path was not found.
std::optional<OtherStart> start_on_other_path(const PointSolver& solver, const PathNode& node,
                                              const OtherPath& other, int choice);

}  // namespace eigentrail
