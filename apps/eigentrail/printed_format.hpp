// Options for what a command prints in place of a table for people.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>

#include "records.hpp"

namespace eigentrail::app {

/// Adds --csv and --json, which are returned; one excludes the other.
inline std::array<CLI::Option*, 2> add_formats(CLI::App& command, PrintedFormat& format,
                                               const std::string& csv_help) {
  CLI::Option* csv = command.add_flag("--csv", format.csv, csv_help);
  return {csv, command.add_flag("--json", format.json, "print a list of objects")->excludes(csv)};
}

}  // namespace eigentrail::app
