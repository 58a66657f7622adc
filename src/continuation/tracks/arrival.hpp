// Eigenvalues that come from infinity, or run there: from which magnitude on they are modes.
#pragma once

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

}  // namespace eigentrail
