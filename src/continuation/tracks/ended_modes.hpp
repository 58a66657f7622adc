// Modes that cannot be followed beyond a point: they end there, the others go on, and they are looked for
// again at the next points.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"

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

}  // namespace eigentrail
