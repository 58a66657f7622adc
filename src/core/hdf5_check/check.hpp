// Checks an HDF5 file before the HDF5 library reads it. The library trusts much of a file's content: damaged
// files make it access memory out of bounds, loop forever, or request all memory. Every structure that the
// library will follow is checked here first. Features that files of matrices or results do not need are
// refused.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail {

/// Throws Hdf5Error, with the position in bytes, if the structure of a file is damaged, if the file refers to
/// other files (links, external and virtual datasets), or if it declares far more data than it holds.
void check_hdf5_file(const std::string& path);

/// The same for the bytes of a file.
void check_hdf5_bytes(std::string_view file);

}  // namespace eigentrail
