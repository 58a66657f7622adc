// The gap between sorted places that holds another place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace eigentrail {

/// Index of the left one of the two neighbouring places between which x is; beyond an end, of the first or
/// last gap. `places`: ascending, two at least.
inline std::size_t gap_of(const std::vector<double>& places, double x) {
  const auto right = std::upper_bound(places.begin() + 1, places.end() - 1, x);
  return static_cast<std::size_t>(right - places.begin()) - 1;
}

}  // namespace eigentrail
