// Sizes of Newton corrections of the steady equations that count as rounding, relative to the scale.
#pragma once

namespace eigentrail {

/// Corrections below this count as rounding.
inline constexpr double newton_rounding = 1e-14;
/// Corrections that no longer decrease count as rounding if they are below this.
inline constexpr double newton_rounding_floor = 1e-9;

}  // namespace eigentrail
