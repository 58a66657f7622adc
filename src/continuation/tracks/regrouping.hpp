// Changes of the tracks at a point: close modes are joined into blocks, blocks whose modes are no longer
// close are separated, and single modes change their chart.
#pragma once

#include "continuation/tracks/partner.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Joins `track` with its partners to one track at the end of the node's list. Returns false, and does not
/// change the node, if the block does not converge to the eigenvalues of its members, or would have more than
/// `largest`.
bool join(const PathProblem& problem, PathNode& node, std::size_t track, const std::vector<Partner>& partners,
          RunCounts& counts, Eigen::Index largest = largest_block);

/// Joins a track with another one because their eigenvalues are close, and not because they are seen to meet.
/// They stay together as long as they are about as close.
bool join_and_keep(const PathProblem& problem, PathNode& node, std::size_t track, const Partner& partner,
                   RunCounts& counts, Eigen::Index largest = largest_block);

/// Some members of a block as a track of their own. Empty if they are too close to the other eigenvalues or
/// the corrector fails.
std::optional<Track> separate(const PathProblem& problem, const PathNode& node, const Track& track,
                              const std::vector<int>& members, RunCounts& counts);

/// A block without some of its members; without its departure, if it has one. Empty if the others are too
/// close to them or the corrector fails.
std::optional<Track> without(const PathProblem& problem, const PathNode& node, const Track& track,
                             const std::vector<int>& members, RunCounts& counts);

/// When a block is separated.
struct PartingRules {
  double reach = 3.0;     ///< in steps: meetings within this distance keep a block together
  double accepted = 0.0;  ///< largest relative error of a step
};

/// Separates blocks into those eigenvalues that have meetings within the reach of a step of length h to
/// either side of the node. If this leaves a block as it is, separates eigenvalues that would be accurate
/// enough as single modes, estimated from the last step, of length `last_step` from `left` (null at the
/// start).
void part(const PathProblem& problem, const PathNode* left, PathNode& node, double h, double last_step,
          const PartingRules& rules, RunCounts& counts);

/// Changes the chart of a single mode. False, without a change, if that fails.
bool change_chart(const PathProblem& problem, PathNode& node, std::size_t track, RunCounts& counts);

/// Whether the series of a single mode converges faster in the other chart on a step of length h.
bool prefers_other_chart(const Track& track, double h);

}  // namespace eigentrail
