// Traces of few modes of many against those of all modes: the same events, and no mode that ends.
#pragma once

#include <string>
#include <vector>

#include "completeness/random_family.hpp"

namespace eigentrail::test {

/// Traces the slowest modes of a family, as many as each of `numbers` says, with the default tolerance, and
/// compares flutter, divergence and collisions with those of a trace of all modes, whose first ones are the
/// same. An event of a mode that only the trace of all follows may be missing. Returns what is wrong, a line
/// each.
std::vector<std::string> check_few_modes(const RandomFamily& family, const std::vector<int>& numbers);

}  // namespace eigentrail::test
