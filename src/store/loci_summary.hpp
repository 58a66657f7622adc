// What a loci file is given when its trace has ended.
#pragma once

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {

/// Rows of the datasets along the dimension `event`, from number `first` on: those before are written.
void write_events(Hdf5File& file, const std::vector<Event>& events, std::size_t first);

/// Attributes: how the trace ended, and what it cost.
void write_summary(Hdf5File& file, const TraceResult& result);

}  // namespace eigentrail
