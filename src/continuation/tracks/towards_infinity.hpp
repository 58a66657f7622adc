// Eigenvalues that run to infinity like the reciprocal root of the distance from a place on the path, as
// where a massless freedom loses its stiffness: mu = 1/s vanishes there like (p0 - p)^(1/2), and no series
// carries it through. Others come from there, and are modes from some magnitude on. Where the mass is
// singular for one p only, mu passes zero smoothly, and is followed.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Which eigenvalues end. No result depends on the exact values.
struct InfinityThresholds {
  /// As a share of the magnitude that counts as infinite: from here on such an eigenvalue ends. A larger
  /// value follows it farther, at the cost of short steps.
  double leaves = 0.01;
  /// As a share of the same: up to here one that came from infinity is added to the modes. With a larger
  /// value it is added sooner, and its first steps are shorter.
  double arrived = 0.005;
  /// Largest |mu mu'' / mu'^2 + 1| of mu = 1/s that vanishes like a square root, for which it is zero; it is
  /// one where mu passes zero smoothly. The same for |Im| / |Re| of the distance of that place.
  double like_a_root = 0.2;
};

/// Whether an eigenvalue that nobody follows may be taken: it is not so large that it has just come from
/// infinity (InfinityThresholds::arrived), or the mass is regular and no eigenvalue is infinite nearby.
bool has_arrived(const PathProblem& problem, const PathNode& node, Complex s,
                 const InfinityThresholds& thresholds = {});

/// An eigenvalue of a point that runs to infinity ahead.
struct RunToInfinity {
  std::size_t track = 0;
  int member = 0;          ///< index of its root in the track
  double distance = 0.0;   ///< of the place, along the path, positive
  double magnitude = 0.0;  ///< |s| at the point
};

/// All eigenvalues that run to infinity in this direction of the path, from their series up to second order:
/// mu mu'' / mu'^2 is -1 for a square root, and 0 where mu passes zero smoothly. Members of blocks that have
/// no series of their own are left out.
std::vector<RunToInfinity> runs_to_infinity(const PathNode& node, double direction,
                                            const InfinityThresholds& thresholds = {});

/// What became of the eigenvalues that are large enough to end.
struct EndedAtInfinity {
  std::vector<std::string> who;  ///< a text for each track: its modes with their eigenvalues
  std::vector<int> modes;        ///< their numbers
  double behind = 0.0;           ///< length of a step to where they have come back behind infinity; 0 without
};

/// Ends those of `runs` that are large enough (InfinityThresholds::leaves). The other members of their blocks
/// go on as blocks of their own; where these cannot be separated the eigenvalue does not end.
EndedAtInfinity end_at_infinity(const PathProblem& problem, const std::vector<RunToInfinity>& runs,
                                PathNode& node, RunCounts& counts, const InfinityThresholds& thresholds = {});

}  // namespace eigentrail
