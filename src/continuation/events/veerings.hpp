// Veerings: exceptional points beside the real parameter axis, where two modes come close and part again.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The veerings on a step, or just beside its ends, of any two modes.
FoundEvents find_veerings(const EventSearch& search, const Step& step);

}  // namespace eigentrail
