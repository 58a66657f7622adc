// The summary of a trace that the program prints.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail::app {

struct TraceSummary {
  const TraceSetup& setup;
  const TraceResult& result;
  const RecordedPath& path;
  const std::vector<std::string>& mode_names;
  const std::vector<StableRange>& ranges;
  const DataErrors* errors;  ///< null if the model has no errors of data
};

/// Prints modes at both ends, onsets of instability, critical speeds, other special points and stable ranges,
/// and the work in one line; with `verbose`, all its figures.
void print_summary(const TraceSummary& trace, bool verbose);

}  // namespace eigentrail::app
