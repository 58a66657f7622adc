// Prints stable ranges as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail::app {

/// Prints the ranges, one line each, under a heading. `whose`: the modes to which they refer, if not to all,
/// for example "4 of 10 modes followed".
void print_ranges(const std::vector<StableRange>& ranges, const std::string& parameter,
                  const std::string& whose);

/// A list of objects with kind, from, to and margins. from and to are objects with parameter, cause, margin
/// and mode (from 1; null if none is known).
nlohmann::ordered_json ranges_json(const std::vector<StableRange>& ranges);

}  // namespace eigentrail::app
