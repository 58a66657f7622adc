// Veerings: exceptional points at complex parameters close to the real axis. On the real axis two eigenvalues
// approach, turn away from each other and exchange their shapes.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The veerings of any two modes on a step or close to its ends, up to the largest half-width: where Newton's
/// method for exceptional points (exceptional_point.hpp) leads from where the dense output predicts them.
/// Left out are those whose place the series of the pencil do not tell: where the system changes within less
/// than a half-width. Cost per prediction: the reduced equations at a point, and an LU per iteration.
FoundEvents find_veerings(const EventSearch& search, const Step& step);

}  // namespace eigentrail
