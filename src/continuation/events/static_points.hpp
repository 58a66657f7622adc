// Events of the equilibrium: where its path bends back (fold), and where another path crosses (branch point).
#pragma once

#include "continuation/events/event_search.hpp"

namespace eigentrail {

/// The fold at the end of a step, if the path bends back there.
FoundEvents find_fold(const EventSearch& search, const PathNode& node, double h);

/// The branch point that a point lies on, if the frame's bridge says so. The survey of its paths is not part
/// of it (other_path.hpp).
FoundEvents find_branch_point(const EventSearch& search, const PathNode& node);

/// An event at s = 0 as what it is where the equilibrium is not isolated: the fold or the branch point is an
/// event of its own, and then nothing is found; else another path crosses, and the event is a branch point.
/// Any other event is returned as it is.
FoundEvents as_static_event(const EventSearch& search, const PathNode& node, Event event);

}  // namespace eigentrail
