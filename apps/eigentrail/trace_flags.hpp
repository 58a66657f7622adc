// The options of a trace on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail::app {

/// Adds the options of traces to a command, which override those of the scene; their texts go to `texts`.
void add_trace_options(CLI::App& command, std::map<std::string, std::string>& texts);

/// Adds --no-lock.
void add_no_lock(CLI::App& command, SaveOptions& saving);

}  // namespace eigentrail::app
