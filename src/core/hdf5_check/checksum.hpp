// The checksum of HDF5's newer structures.
#pragma once

#include <cstdint>
#include <string_view>

namespace eigentrail::hdf5_check {

/// Jenkins' lookup3 (2006), as HDF5 uses it: "hashlittle" from zero.
std::uint32_t checksum(std::string_view bytes);

}  // namespace eigentrail::hdf5_check
