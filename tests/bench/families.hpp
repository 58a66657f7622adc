// Scenes that the benchmarks trace: random families of matrices of any size, and chains of points.
#pragma once

#include <string>

#include "support/scenes.hpp"

namespace eigentrail::test {

constexpr double close = 0.1, apart = 1.0;  ///< distances of frequencies, rad/s

/// Undamped frequencies from 3 rad/s on, equally spaced, that a random symmetric stiffness moves for p from 0
/// to 1, with light damping and a skew-symmetric C proportional to p. If the spacing is `close`, neighbours
/// veer with half-widths of some percent of the range; if it is `apart`, they do not meet. The spacing of
/// modes and the widths of veerings do not depend on n.
Setting gyroscopic_family(int n, unsigned seed, const OptionTexts& overrides, double spacing = close);

/// The same without C, neighbours close.
Setting undamped_family(int n, unsigned seed, const OptionTexts& overrides);

/// A planar chain of four rods and points with springs, drag and forces that hangs in gravity while its upper
/// rod grows from 1 to 1.5 m.
Setting hanging_chain();

}  // namespace eigentrail::test
