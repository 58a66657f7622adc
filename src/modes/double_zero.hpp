// How well a double eigenvalue zero is known.
#pragma once

namespace eigentrail {

/// Relative to the largest eigenvalue of the system. A defective double zero, a rigid-body motion for
/// example, is known only to the square root of rounding, 1.5e-8; this is twice that.
inline constexpr double double_zero = 3e-8;

}  // namespace eigentrail
