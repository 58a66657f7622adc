// A stability map as characters.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/stability/stability_map.hpp"

namespace eigentrail::app {

/// Lines of text: the second parameter upwards, the first to the right, with their names and values on the
/// axes. '.' no mode grows, digits the number of growing modes ('+' above nine), '?' unknown. Large maps show
/// every so many cells only.
std::vector<std::string> map_picture(const StabilityMap& map, const std::string& first,
                                     const std::string& second);

}  // namespace eigentrail::app
