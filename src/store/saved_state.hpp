// The state of an unfinished trace, which is appended to the HDF5 data of its loci file. HDF5 readers ignore
// these bytes.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail {

/// The bytes to append to the HDF5 data `image`: the states of the trace and of its writer, and a mark with
/// their size and a checksum of image and states by which they are recognized.
std::string saved_state(std::string_view image, const std::string& trace, const std::string& writer);

}  // namespace eigentrail
