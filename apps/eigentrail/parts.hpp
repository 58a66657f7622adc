// Options and messages of commands whose work may be shared: --part, and eigentrail merge.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/store/part_file.hpp"
#include "eigentrail/store/unfinished_run.hpp"
#include "team.hpp"

namespace eigentrail::app {

/// What is written to standard output at the end of a run, and what can replace what.
struct OutputChoice {
  std::string path;
  bool force = false;
  bool resume = false;
  bool quiet = false;
};

/// Adds --force, --resume and --quiet.
void add_output_flags(CLI::App& command, OutputChoice& output,
                      const std::string& replaced = "replace an existing output");

/// What the run with this output, or this part of it, has left. Says on the process that leads where it was
/// computed with another kernel of BLAS. Where there is something to go on from, the output may be replaced:
/// it is older.
std::unique_ptr<UnfinishedRun> unfinished_run(OutputChoice& output, SharedRun run,
                                              const std::optional<Part>& part, const Team& team);

/// Whether --resume has nothing to do: the output, or this part of it, is complete, which is then said.
/// Throws InputError if it is of another run.
bool has_ended(const OutputChoice& output, const Team& team, const SharedRun& run,
               const std::optional<Part>& part = {});
/// The same for an output that is not one file; `complete` is called where there is one.
bool has_ended(const OutputChoice& output, const Team& team, const std::function<bool()>& complete);

/// Adds --part to a command.
void add_part(CLI::App& command, std::optional<Part>& part);

/// Ends a run whose pieces have all been computed: `write` writes the output and returns the exit code. What
/// was saved of the run stays if the output cannot be written, and goes if there is none for this input.
int end_run(UnfinishedRun& unfinished, const std::function<int()>& write);

/// Name of the output that was not given: SCENE_map.h5, or SCENE_map.part-2-of-5.h5 for a part.
std::string default_output(const std::string& scene, const std::string& ending,
                           const std::optional<Part>& part);

/// Checks that a part may be written, and writes it with a note on what to do next.
void check_part_output(const OutputChoice& output);
int write_part(const OutputChoice& output, SharedRun run, const Part& part, std::vector<std::string> pieces);

/// A number among the settings of a part.
double number_of(const SharedRun& run, const std::string& label);

// What eigentrail merge does with the joined pieces of each command. They return an exit code.
int merge_map(const SharedRun& run, const std::vector<std::string>& pieces, const OutputChoice& output,
              Team& team);
int merge_boundary(const SharedRun& run, const std::vector<std::string>& pieces, const OutputChoice& output,
                   Team& team);
int merge_sweep(const SharedRun& run, const std::vector<std::string>& pieces, const OutputChoice& output,
                Team& team);

}  // namespace eigentrail::app
