// Files that a scene names.
#pragma once

#include <string>

#include "core/hdf5_file.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Path of the file that a key of a table names, relative to the folder of the scene. Throws
/// InputError unless the file is in that folder or below it, also after symbolic links are resolved. A file
/// that does not exist is not reported here.
std::string beside_scene(const Scene& scene, TableReader& table, const std::string& key = "file");

/// Opens the HDF5 file that the key `file` of a table names: one that the scene has in memory, or the one
/// beside it. Throws InputError as beside_scene, and Hdf5Error if it cannot be opened.
Hdf5File open_beside_scene(const Scene& scene, TableReader& table);

}  // namespace eigentrail
