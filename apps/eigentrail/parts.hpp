// Options and messages of commands whose work may be shared: --part, and eigentrail merge.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eigentrail/store/part_file.hpp"
#include "team.hpp"

namespace eigentrail::app {

/// What is written to standard output at the end of a run, and what can replace what.
struct OutputChoice {
  std::string path;
  bool force = false;
  bool quiet = false;
};

/// Adds --part to a command.
void add_part(CLI::App& command, std::optional<Part>& part);

/// Name of the output that was not given: SCENE_map.h5, or SCENE_map.part-2-of-5.h5 for a part.
std::string default_output(const std::string& scene, const std::string& ending,
                           const std::optional<Part>& part);

/// Checks that a part may be written, and writes it with a note on what to do next.
void check_part_output(const OutputChoice& output);
void write_part(const OutputChoice& output, SharedRun run, const Part& part, std::vector<std::string> pieces);

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
