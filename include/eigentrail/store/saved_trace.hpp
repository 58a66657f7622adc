// The state of an unfinished trace that a loci file contains, from which the trace can be resumed.
#pragma once

#include <optional>
#include <string>

#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

struct SavedTrace {
  std::string trace;   ///< state of the trace, for resume_trace
  std::string writer;  ///< state of the LociWriter
  std::string image;   ///< bytes of the HDF5 data
  RecordedPath path;   ///< points and steps that were computed
  /// Kernels of BLAS with which they were computed, if not all are those of this processor; otherwise empty.
  std::string other_kernel = {};
};

/// Reads the state of an unfinished trace; empty if the trace was finished. Throws InputError if the file
/// cannot be read, or was written for another scene, with other options or by another version of the program;
/// the message names the difference.
std::optional<SavedTrace> read_saved_trace(const std::string& path, const Scene& scene,
                                           const TraceOptions& options);

}  // namespace eigentrail
