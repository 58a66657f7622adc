// The state of a trace that is not finished, behind the HDF5 data of its loci file. Whatever reads HDF5
// passes over it.
#pragma once

#include <string>

#include "eigentrail/store/saved_trace.hpp"

namespace eigentrail {

/// The bytes that go behind the HDF5 data: both states, and what tells them from anything else there.
std::string saved_state(const SavedTrace& saved);

}  // namespace eigentrail
