// Traces of few modes of many against those of all modes: the same events, and no mode that ends.
#pragma once

#include <string>
#include <vector>

#include "completeness/random_family.hpp"

namespace eigentrail::test {

struct FewModesReport {
  std::vector<std::string> problems;  ///< a line each; empty if nothing is wrong
  int nodes = 0, nodes_of_all = 0;    ///< of the traces of few modes together, and of all
};

/// Traces the slowest modes of a family, as many as each of `numbers` says, with the default tolerance, from
/// `to` to `from` if `reversed`, and compares flutter, divergence and collisions with those of a trace of all
/// modes, whose first ones are the same. An event of a mode that only the trace of all follows may be
/// missing.
FewModesReport check_few_modes(RandomFamily family, const std::vector<int>& numbers, bool reversed = false);

}  // namespace eigentrail::test
