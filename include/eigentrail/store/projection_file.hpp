// The matrices of a projected model as a family of their own.
#pragma once

#include <string>

#include "eigentrail/projection/project.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Writes the matrices of the projected model to `path` (HDF5), under the names of the large ones, and beside
/// it the scene of the large model with this file instead (.toml). Returns the path of the scene. The
/// coordinates are those of the projection; shapes are not those of the large model any more. Throws
/// InputError if a file exists and `force` is not set, std::system_error if they cannot be written.
std::string write_projected(const std::string& path, const Scene& scene, const ProjectedFamily& family,
                            bool force);

}  // namespace eigentrail
