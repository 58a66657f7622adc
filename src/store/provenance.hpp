// Root attributes that tell how a file was made.
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Format, schema and program version, the scene's text, the traced parameter, the tolerance, and one
/// "option_..." per option of the trace.
void write_provenance(Hdf5File& file, const std::string& format, int schema_version, const Scene& scene,
                      const TraceOptions& options);

/// The attribute "notes": what the user should know, in words.
void write_notes(Hdf5File& file, const std::vector<std::string>& notes);

}  // namespace eigentrail
