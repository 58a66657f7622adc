// Writes the events and the summary of a trace to its loci file, at every save and at the end.
#pragma once

#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/trace.hpp"

namespace eigentrail {

/// Removes all events.
void clear_events(Hdf5Writer& file);

/// Writes the events from number `first` on to the datasets along the dimension `event`; those before have
/// been written already.
void write_events(Hdf5Writer& file, const std::vector<Event>& events, std::size_t first);

/// Writes the root attributes on the outcome and the work of the trace.
void write_summary(Hdf5Writer& file, const TraceResult& result);

}  // namespace eigentrail
