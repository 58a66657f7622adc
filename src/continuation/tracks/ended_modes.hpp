// Modes that cannot be followed beyond a point: they end there, the others go on, and they are looked for
// again at the next points.
//
// Eigenvalues that run to infinity like the reciprocal root of the distance from a place on the path, as
// where a massless freedom loses its stiffness: mu = 1/s vanishes there like (p0 - p)^(1/2), and no series
// carries it through. Others come from there, and are modes from some magnitude on. Where the mass is
// singular for one p only, mu passes zero smoothly, and is followed.
#pragma once

#include <string>
#include <vector>

#include "continuation/tracks/completeness.hpp"

namespace eigentrail {

/// A track at the point where it ended.
struct EndedTrack {
  Track track;
  int looks = 0;  ///< points at which it was looked for since
};

/// Removes a track from a point and adds it to the list. Returns a text: the modes with their eigenvalues and
/// what moves most in them. Empty if no mode of the track is followed by itself.
std::string end_track(const PathProblem& problem, PathNode& node, std::size_t track,
                      std::vector<EndedTrack>& ended);

/// Looks for ended tracks at a later point, by Newton's method from their last pairs. Those that converge to
/// similar shapes, at eigenpairs that no other track has, are added to the point with their mode numbers.
/// Returns a text for each. A track is looked for at the next few points only. Cost: a few LU for each.
std::vector<std::string> find_again(const PathProblem& problem, PathNode& node,
                                    std::vector<EndedTrack>& ended, RunCounts& counts);

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
