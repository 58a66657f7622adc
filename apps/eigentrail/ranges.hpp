// Stable ranges for people and scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail::app {

/// Prints the ranges, one line each, under a heading. `whose` says of which modes when not of all: "4 of 10
/// modes followed".
void print_ranges(const std::vector<StableRange>& ranges, const std::string& parameter,
                  const std::string& whose);

/// A list of objects with kind, from, to, margins; from and to are objects with parameter, cause, margin and
/// mode (from 1, null when none stands out).
nlohmann::ordered_json ranges_json(const std::vector<StableRange>& ranges);

}  // namespace eigentrail::app
