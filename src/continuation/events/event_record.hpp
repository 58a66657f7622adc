// Data of an event besides its place: the eigenvector, and the derivatives of the eigenvalue and of the place
// with respect to every parameter of the scene.
#pragma once

#include <functional>
#include <vector>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Derivative along the path of the mean of some eigenvalues of a block, in its chart. NaN where they cannot
/// be separated from the other eigenvalues of the block.
Complex mean_slope(const Track& track, const std::vector<Complex>& roots);

/// Sets the shape of the event: the eigenvector of the first of `members` of a track, evaluated from the
/// series at a distance `offset` from the point.
void keep_shape(const PathNode& node, const Track& track, const std::vector<int>& members, double offset,
                Event& event);

/// The same from a shape of a mode of a part, in physical coordinates. Also begins the list of the event's
/// copies, with their shapes.
void keep_shape(const PathNode& node, int part, const ComplexVector& shape, Event& event);

/// Sets all sensitivities of an event and its copies to NaN.
void leave_unknown(const PathProblem& problem, Event& event);

/// The path point of a node as it was before differentiation, without pencil and modes.
PathPoint solved_point(const PathProblem& problem, const PathNode& node, RunCounts& counts);

/// Derivative of the place of an event, in the path's coordinate h, with respect to another parameter q. If
/// the event is a zero of g, moves(along_path, node_q, along_q) = -(dg/dq) / (dg/dh). Arguments: the track
/// with its series in h; the node, and the track, with their series in q. NaN where it is not known; empty
/// where it is not known for any parameter.
using Movement = std::function<double(const Track&, const PathNode&, const Track&)>;

/// Sets ds/dq of the mean of `members`, and dp*/dq, for every parameter q, also of the event's copies. Both
/// are NaN where they are not known. Every q costs one more back-substitution.
void keep_sensitivities(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                        const Track& track, const std::vector<int>& members, const Movement& moves,
                        Event& event, RunCounts& counts);

/// The Movement of a crossing or collision of two eigenvalues of one block. NaN for more than two and for
/// veerings.
double shift_of_meeting(const Track& along_path, const Track& along_q, EventKind kind,
                        const std::vector<int>& members);

/// Sets dp*/dq of a fold for every parameter q.
void keep_fold_sensitivities(const PathProblem& problem, const PathNode& node, Event& event,
                             RunCounts& counts);

}  // namespace eigentrail
