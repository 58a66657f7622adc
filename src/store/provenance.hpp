// Root attributes on how a file was made.
#pragma once

#include <string>
#include <vector>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Writes format, schema version, program version, title, text and path of the scene, the traced parameter,
/// the tolerance, and one attribute "option_..." per option of the trace.
void write_provenance(Hdf5Writer& file, const std::string& format, int schema_version, const Scene& scene,
                      const TraceOptions& options);

/// Throws InputError if a file, called `path`, has another schema than this program reads.
void check_schema(const Hdf5File& file, const std::string& path, int expected);

/// Writes the attribute "notes": sentences for the user, joined by "; ".
void write_notes(Hdf5Writer& file, const std::vector<std::string>& notes);

}  // namespace eigentrail
