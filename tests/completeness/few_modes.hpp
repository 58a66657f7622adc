// Traces of few modes of many against those of all modes: the same events, and no mode that ends.
#pragma once

#include <string>
#include <vector>

#include "completeness/random_family.hpp"

namespace eigentrail::test {

struct FewModesReport {
  std::vector<std::string> problems;  ///< a line each; empty if nothing is wrong
  int nodes = 0, nodes_of_all = 0;
};

/// Traces the `modes` slowest modes of a family with the default tolerance, from `to` to `from` if
/// `reversed`, and compares flutter, divergence and collisions with those of a trace of all modes, whose
/// first ones are the same. An event of a mode that only the trace of all follows may be missing.
FewModesReport check_few_modes(RandomFamily family, int modes, bool reversed = false);

}  // namespace eigentrail::test
