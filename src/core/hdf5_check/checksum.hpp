// The checksum of the newer HDF5 structures.
#pragma once

#include <cstdint>
#include <string_view>

namespace eigentrail::hdf5_check {

/// Jenkins' lookup3 hash (2006), function "hashlittle" with initial value 0, as in HDF5.
std::uint32_t checksum(std::string_view bytes);

}  // namespace eigentrail::hdf5_check
