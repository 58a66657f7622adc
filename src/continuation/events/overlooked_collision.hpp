// A check that no collision on the real axis was overlooked on a step: only there do the real eigenvalues of
// a block change their number.
#pragma once

#include "continuation/step/step.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// Whether a block that meets nowhere on the step, and not at its right end, has more real eigenvalues at one
/// end than at the other. Blocks in which rounding hides which are real at an end are left out.
bool overlooks_collision(const Step& step, const RoundingThresholds& thresholds);

}  // namespace eigentrail
