// Large scenes of beams for tests and benchmarks.
#pragma once

#include <string>

#include "support/scenes.hpp"

namespace eigentrail::test {

/// The cantilever of data/scenes/rotating_cantilever.toml with `elements` elements of two nodes: 12
/// coordinates and 6 freedoms for each, and 12 coordinates more. `weight` per length, across the beam.
Setting slender_cantilever(int elements, const OptionTexts& overrides, const std::string& weight = "0");

/// Text of a scene: two rails along x, clamped in the rotating frame, with rungs along y between bodies at
/// the ends of every bay. 204 coordinates for each bay.
std::string ladder(int bays);

}  // namespace eigentrail::test
