// The summary of a trace that the program prints, and parts of it for files of traces.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/stability/permanent_modes.hpp"
#include "eigentrail/stability/stable_ranges.hpp"
#include "eigentrail/store/loci_file.hpp"

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

/// The permanence of every mode of a loci file; none is permanent where the file does not tell tolerance and
/// reference of its trace.
std::vector<Permanence> permanence_of_modes(const LociFile& loci);

/// Prints which modes do not move with the parameter, and what moves in those that are zero throughout, which
/// the stable ranges leave out. Nothing if all modes move. `names`: what moves, per mode; may be empty.
void print_permanent(const std::vector<Permanence>& all, const std::vector<std::string>& names);

/// Prints the ranges, one line each, under a heading.
void print_ranges(const std::vector<StableRange>& ranges, const std::string& parameter);

}  // namespace eigentrail::app
