// What a trace has found, besides its points and events.
#pragma once

#include <optional>
#include <vector>

#include "eigentrail/continuation/data_errors.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/stability/stable_ranges.hpp"

namespace eigentrail {

struct Findings {
  RecordedPath path;
  std::vector<StableRange> ranges;  ///< stable, marginal and undecided ones
  std::optional<DataErrors>
      errors;  ///< that come from the data of the model; empty if it has none of its own
};

/// Completes a trace that has ended. Where no mode came into the band that `options` ask for, its status and
/// message say so. Where the data of the model have errors, extrema of damping ratios that are no deeper than
/// these are taken out of the events of `result`, with a note.
Findings find_ranges_and_errors(const Model& model, const TraceOptions& options, RecordedPath path,
                                TraceResult& result);

}  // namespace eigentrail
