// Events of the equilibrium path: folds, where it turns back, and branch points, where another path crosses.
//
// With trimmed parameters the steady equations with the conditions of the trim are singular where another
// path crosses: the determinant of their matrix changes its sign there, and dp/dsigma does not. At a fold
// both do. Zeros of the pencil, in which trimmed parameters are held, say nothing of either.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The fold at the end of a step, if the path turns back there. If the force of the traced parameter has no
/// share in the kernel of the stiffness, the point is a branch point and is returned as such; where two folds
/// fall together, it is a cusp. h: signed length of the step.
FoundEvents find_fold(const EventSearch& search, const PathNode& node, double h);

/// The branch point, if the node is the branch point on the frame's bridge. The paths there are examined in
/// other_path.hpp.
FoundEvents find_branch_point(const EventSearch& search, const PathNode& node);

/// Replaces an event that a zero eigenvalue causes at a fold or branch point. There a divergence, collision,
/// or crossing of one mode with its conjugate at s = 0 is a consequence of the singular stiffness. Returns
/// nothing at a fold or at the branch point of the bridge, which are events of their own; else, if another
/// path crosses, a branch point; at a cusp that no fold was seen at, the cusp. Any other event is returned
/// unchanged.
FoundEvents as_static_event(const EventSearch& search, const PathNode& node, Event event);

/// The place on a step where another trimmed path crosses; nothing for models without trimmed parameters. Two
/// crossings on one step are not seen. Costs two dense factorizations per step, and one for every halving of
/// the step where there is a crossing.
FoundEvents find_trimmed_crossing(const EventSearch& search, const Step& step);

}  // namespace eigentrail
