// Writes stability boundaries to an HDF5 file (format "eigentrail-boundary", schema 1).
#pragma once

#include <string>

#include "eigentrail/stability/boundary.hpp"

namespace eigentrail {

inline constexpr int boundary_schema_version = 1;
inline constexpr const char* boundary_format = "eigentrail-boundary";

/// Refuses names of the two parameters that the file uses for something else. Throws InputError.
void check_boundary_names(const Scene& scene, const BoundaryOptions& options);

/// Writes the whole file; it appears under its name complete or not at all, and an existing one is replaced
/// in that moment. Throws std::runtime_error when it cannot be written.
void write_boundaries(const std::string& path, const BoundarySetup& setup, const BoundaryResult& result);

}  // namespace eigentrail
