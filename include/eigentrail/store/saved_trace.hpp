// What a loci file holds for a trace that goes on with it.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct SavedTrace {
  std::string trace;   ///< for resume_trace
  std::string writer;  ///< for LociWriter
  std::string image;   ///< the HDF5 file
  RecordedPath path;   ///< what was traced
};

/// Reads the state of a trace that was not finished, after checking that it was a trace of this scene with
/// these options by this version of the program. Empty when the trace was finished. Throws InputError that
/// names what differs, or why the file cannot be read.
std::optional<SavedTrace> read_saved_trace(const std::string& path, const Scene& scene,
                                           const TraceOptions& options);

}  // namespace eigentrail
