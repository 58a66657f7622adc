// What is done when a trace has come to its end.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/stability/stable_ranges.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail::app {

struct TraceEnd {
  std::vector<StableRange> ranges;
  std::optional<DataErrors> errors;  ///< absent if the model's data have none
};

/// Finds stable ranges and errors of the data, removes extrema that these errors hide, and completes the
/// file.
TraceEnd complete_file(const TraceSetup& setup, TraceResult& result, const RecordedPath& path,
                       LociWriter& writer);

/// Adds the options of traces to a command, which override those of the scene; their texts go to `texts`.
void add_trace_options(CLI::App& command, std::map<std::string, std::string>& texts);

}  // namespace eigentrail::app
