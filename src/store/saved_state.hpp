// The state of a trace that is not finished, behind the HDF5 data of its loci file. Whatever reads HDF5
// passes over it.
#pragma once

#include <string>

namespace eigentrail {

/// The bytes that go behind the HDF5 data: the states of the trace and of its writer, and what tells them
/// from anything else there.
std::string saved_state(const std::string& trace, const std::string& writer);

}  // namespace eigentrail
