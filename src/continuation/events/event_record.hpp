// What an event keeps beside its place: the eigenvector, and how it depends on every parameter of the scene.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// d/dh of the mean of some eigenvalues of a block, in its chart; NaN where they are not told from the
/// others.
Complex mean_slope(const Track& track, const std::vector<Complex>& roots);

/// Sets the eigenvector of the first of `members` of a track, at an offset from the point.
void keep_shape(const PathNode& node, const Track& track, const std::vector<int>& members, double offset,
                Event& event);

/// The point of the path that a node is the series of, as it was before it was differentiated; no modes.
PathPoint solved_point(const PathProblem& problem, const PathNode& node, RunCounts& counts);

/// How far an event moves along the path for a change of another parameter, from the track along both:
/// moves(along_path, node_q, along_q) = -(dg/dq) / (dg/dh); NaN where it is not known.
using Movement = std::function<double(const Track&, const PathNode&, const Track&)>;

/// Sets ds/dq of the mean of `members`, and dp*/dq, for every parameter q. One more back-substitution each.
void keep_sensitivities(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                        const Track& track, const std::vector<int>& members, const Movement& moves,
                        Event& event, RunCounts& counts);

/// Movement of a meeting of two eigenvalues of one block; NaN for more, and beside the real axis.
double shift_of_meeting(const Track& along_path, const Track& along_q, EventKind kind,
                        const std::vector<int>& members);

/// Sets dp*/dq of a fold for every parameter q.
void keep_fold_sensitivities(const PathProblem& problem, const PathNode& node, Event& event,
                             RunCounts& counts);

}  // namespace eigentrail
