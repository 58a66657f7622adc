// How small a Newton correction of the steady equations must be to count as rounding; relative to the scale.
#pragma once

namespace eigentrail {

/// Corrections below this fraction of the scale are rounding.
inline constexpr double newton_rounding = 1e-14;
/// Corrections that no longer shrink are accepted as rounding below this fraction of the scale.
inline constexpr double newton_rounding_floor = 1e-9;

}  // namespace eigentrail
