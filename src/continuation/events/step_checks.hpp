// Checks of the events of a step against the eigenvalues at its ends: every change of the number of growing
// modes is a flutter or a divergence, and only in a collision on the real axis do the real eigenvalues of a
// block change their number.
#pragma once

#include <optional>

#include "continuation/events/event_search.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

/// A remark on a step where the number of followed eigenvalues with Re s > 0, pairs counted twice, changes
/// otherwise than the recorded events say, with its place. Empty where both agree, where the number is not
/// known at an end, and where the path turns or branches.
std::optional<std::string> unexplained_growth(const EventSearch& search, const Step& step);

/// Whether a block that meets nowhere on the step, and not at its right end, has more real eigenvalues at one
/// end than at the other. Blocks in which rounding hides which are real at an end are left out.
bool overlooks_collision(const Step& step, const RoundingThresholds& thresholds);

}  // namespace eigentrail
