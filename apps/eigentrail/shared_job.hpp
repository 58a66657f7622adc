// A run of pieces that processes and machines may share: map, boundary, sweep, accuracy, and eigentrail
// merge.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/store/part_file.hpp"
#include "output_choice.hpp"
#include "progress_bar.hpp"
#include "team.hpp"

namespace eigentrail::app {

/// The pieces of a run that have all been computed.
struct ComputedRun {
  const std::vector<std::string>& pieces;
  std::optional<double> seconds;  ///< that computing them took; empty if it is not known
  Workers& workers;
  bool leads;  ///< whether this process writes and prints
};

/// What a command does with the pieces of its run.
struct SharedJob {
  SharedRun run;        ///< carry_out sets its part
  OutputFormat format;  ///< of the output
  int jobs = 0;         ///< threads of a process; 0: one per core
  /// Computes the pieces with these numbers.
  std::function<std::vector<std::string>(const std::vector<std::size_t>& numbers, Workers& workers,
                                         ProgressBar& progress)>
      compute = {};
  /// Makes the output of all pieces, in every process, and writes it in the one that leads. Returns the exit
  /// code.
  std::function<int(const ComputedRun&)> finish = {};
  bool writes = true;  ///< without an output nothing is saved and nothing resumed
  /// Of pieces that leave files behind before the first of them is finished: checks these as the output.
  std::function<void()> check_more_files = {};
  /// Whether an output that is there is the whole one of this run; else the mark in the file says it.
  std::function<bool()> is_whole = {};
  PiecesByName known = {};  ///< pieces that other runs have computed
};

/// Computes the pieces, or those of one part, and finishes the run or writes the part. What an interrupted
/// run has left is used if --resume asks for it, and what this one computes is saved until it ends. Where
/// there is something to go on from, the output may be replaced: it is older. Returns the exit code.
int carry_out(SharedJob job, OutputChoice& output, Team& team);

/// Writes the output of a run with its mark, by which --resume knows it; then says so, below what `print`
/// prints.
void write_result(const OutputChoice& output, const SharedRun& run, const std::string& bytes,
                  const std::function<void()>& print);

/// A number among the settings of a run.
double number_of(const SharedRun& run, const std::string& label);

// The jobs of the commands whose parts can be joined, from the settings of a part. `output` must outlive
// them.
SharedJob map_of_parts(const SharedRun& run, const OutputChoice& output);
SharedJob boundary_of_parts(const SharedRun& run, const OutputChoice& output);
SharedJob sweep_of_parts(const SharedRun& run, const OutputChoice& output);

}  // namespace eigentrail::app
