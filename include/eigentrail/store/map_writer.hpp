// Writes a stability map (HDF5, format "eigentrail-map", schema 1; docs/stability-map.md).
#pragma once

#include <string>
#include <vector>

#include "eigentrail/stability/stability_map.hpp"

namespace eigentrail {

inline constexpr int map_schema_version = 1;
inline constexpr const char* map_format = "eigentrail-map";

/// Refuses names of the two parameters that the file uses for something else. Throws InputError.
void check_map_names(const MapSetup& setup);

/// Writes the whole map; the file appears under its name complete or not at all, an existing one is replaced
/// in that moment. `notes` is what the user should know, in words. Throws std::runtime_error when it cannot
/// be written.
void write_map(const std::string& path, const MapSetup& setup, const StabilityMap& map,
               const std::vector<std::string>& notes);

}  // namespace eigentrail
