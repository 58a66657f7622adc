// Scenes that the benchmarks trace: random families of matrices of any size, and chains of points.
#pragma once

#include <string>

#include "support/scenes.hpp"

namespace eigentrail::test {

/// Undamped frequencies 3, 3.1, 3.2, ... rad/s that a random symmetric stiffness moves across each other for
/// p from 0 to 1, with skew-symmetric C growing like p and light damping: neighbours veer, at half-widths of
/// some percent of the range. Local statistics do not depend on n.
Setting gyroscopic_family(int n, unsigned seed, const OptionTexts& overrides);

/// The same without C.
Setting undamped_family(int n, unsigned seed, const OptionTexts& overrides);

/// A planar chain of rods and points that hangs in gravity while its upper rod grows from 1 to 1.5 m, without
/// the effect of that name ("" leaves out none).
Setting chain_without(const std::string& effect);

/// The effects that can be left out.
const std::vector<std::string>& chain_effects();

}  // namespace eigentrail::test
