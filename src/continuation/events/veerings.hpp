// Veerings: exceptional points at complex parameters close to the real axis. On the real axis two eigenvalues
// approach, turn away from each other and exchange their shapes.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The veerings of any two modes on a step or close to its ends. Dismissed are those that are located but too
/// wide, too narrow, or not confirmed.
FoundEvents find_veerings(const EventSearch& search, const Step& step);

}  // namespace eigentrail
