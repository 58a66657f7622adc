// Writes stability boundaries to an HDF5 file (format "eigentrail-boundary", schema 1).
#pragma once

#include <string>

#include "eigentrail/stability/boundary.hpp"

namespace eigentrail {

inline constexpr int boundary_schema_version = 1;
inline constexpr const char* boundary_format = "eigentrail-boundary";

/// Throws InputError if one of the two parameters has the name of a dataset of the file.
void check_boundary_names(const BoundarySetup& setup);

/// The bytes of the file. Throws std::runtime_error if HDF5 cannot make it.
std::string boundary_file(const BoundarySetup& setup, const BoundaryResult& result);

}  // namespace eigentrail
