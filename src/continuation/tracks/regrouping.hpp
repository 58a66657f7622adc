// What is followed together at a point: close modes are joined into blocks, blocks whose modes have parted
// are taken apart, eigenvalues on their way to infinity change to the reciprocal chart.
//
// Two eigenvalues limit each other's series by the exceptional point where they would meet, a root of
// ((s_i - s_j)/2)^2 in the complex plane of the path's coordinate. That function is smooth, so its own series
// tells where the root lies.
#pragma once

#include "continuation/tracks/partner.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// The partners whose meeting with `track` lies within `reach` steps of the step [0, h], nearest first.
std::vector<Partner> find_partners(const PathNode& node, std::size_t track, double h, double reach);

/// Joins `track` with its partners at the node. Returns false, and leaves the node alone, when the joint
/// block does not converge or would exceed the largest size.
bool join(const PathProblem& problem, PathNode& node, std::size_t track, const std::vector<Partner>& partners,
          RunCounts& counts);

/// Some members of a block as a block of their own; empty when they cannot be told from the others.
std::optional<Track> separate(const PathProblem& problem, const PathNode& node, const Track& track,
                              const std::vector<int>& members, RunCounts& counts);

/// Takes apart the blocks whose eigenvalues meet nowhere within `reach` steps of length h around the node,
/// and those whose members would have been accurate enough alone on the last step, from `left` (null at the
/// start). `accepted` is the relative error that a step may have.
void part(const PathProblem& problem, const PathNode* left, PathNode& node, double h, double last_step,
          double reach, double accepted, RunCounts& counts);

/// Changes the chart of a single mode.
bool change_chart(const PathProblem& problem, PathNode& node, std::size_t track, RunCounts& counts);

/// Whether the series of a single mode falls faster in the other chart on a step h.
bool prefers_other_chart(const Track& track, double h);

}  // namespace eigentrail
