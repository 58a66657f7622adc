// Crossings of trimmed equilibrium paths. The steady equations with the conditions of the trim are singular
// where another path crosses: the determinant of their matrix changes its sign there, and dp/dsigma does not.
// At a fold both do. Zeros of the pencil, in which trimmed parameters are held, say nothing of either.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// The place on a step where another trimmed path crosses; nothing for models without trimmed parameters. Two
/// crossings on one step are not seen. Costs two dense factorizations per step, and one for every halving of
/// the step where there is a crossing.
FoundEvents find_trimmed_crossing(const EventSearch& search, const Step& step);

}  // namespace eigentrail
