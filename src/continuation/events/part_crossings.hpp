// Crossings of modes of independent parts of the equations. The parts do not know of each other: their
// eigenvalues coincide without a meeting, and no point of the trace is needed there.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// Places on a step where eigenvalues of different parts coincide. Modes that coincide on the whole step,
/// those of equal parts, do not cross.
FoundEvents find_part_crossings(const EventSearch& search, const Step& step);

}  // namespace eigentrail
