// The state of an unfinished trace, which is appended to the HDF5 data of its loci file. HDF5 readers ignore
// these bytes.
#pragma once

#include <string>

namespace eigentrail {

/// The bytes to append to the HDF5 data: the states of the trace and of its writer, and a mark with size and
/// checksum by which they are recognized.
std::string saved_state(const std::string& trace, const std::string& writer);

}  // namespace eigentrail
