// Writes a stability map (HDF5, format "eigentrail-map", schema 1; docs/stability-map.md).
#pragma once

#include <string>

#include "eigentrail/stability/stability_map.hpp"

namespace eigentrail {

inline constexpr int map_schema_version = 1;
inline constexpr const char* map_format = "eigentrail-map";

/// Throws InputError if one of the two parameters has the name of a dataset of the file.
void check_map_names(const MapSetup& setup);

/// The bytes of the file. Throws std::runtime_error if HDF5 cannot make it.
std::string map_file(const MapSetup& setup, const StabilityMap& map);

}  // namespace eigentrail
