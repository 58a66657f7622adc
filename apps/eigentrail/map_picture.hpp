// Draws a stability map with characters.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/stability/stability_map.hpp"

namespace eigentrail::app {

/// The map as lines of text: the second parameter increases upwards, the first to the right, with names and
/// values on the axes. '.': no mode grows; digit: number of growing modes, '+' if more than nine; '?':
/// unknown. Of a large map only some of the cells are shown, at equal distances.
std::vector<std::string> map_picture(const StabilityMap& map, const std::string& first,
                                     const std::string& second);

}  // namespace eigentrail::app
