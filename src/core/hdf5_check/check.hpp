// Looks through an HDF5 file before the HDF5 library does. The library trusts much of what a file says:
// damaged ones make it read and write outside of its memory, loop for ever, or ask for all memory. Here every
// structure that it will follow is checked first, and what no file of matrices or results needs is refused.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail {

/// Throws Hdf5Error, which names the place, when a file's structure is damaged, when it leads to other files
/// (links, external and virtual datasets), or when it declares far more data than it holds.
void check_hdf5_file(const std::string& path);

/// The same for its bytes.
void check_hdf5_bytes(std::string_view file);

}  // namespace eigentrail
