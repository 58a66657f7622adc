// The commands of the program. Each function adds its command to the command line. When the command line is
// parsed, the command that was given runs and sets `exit_code`.
#pragma once

#include <CLI/CLI.hpp>

namespace eigentrail::app {

/// Exit codes of the program: success; numerical failure, after which what was computed is kept; invalid
/// input or usage.
enum ExitCode { done = 0, numbers_failed = 1, bad_input = 2 };

void add_new(CLI::App& program, int& exit_code);
void add_suggest(CLI::App& program, int& exit_code);
void add_import(CLI::App& program, int& exit_code);
void add_trace(CLI::App& program, int& exit_code);
void add_spectrum(CLI::App& program, int& exit_code);
void add_eval(CLI::App& program, int& exit_code);
void add_events(CLI::App& program, int& exit_code);
void add_boundary(CLI::App& program, int& exit_code);
void add_map(CLI::App& program, int& exit_code);
void add_sweep(CLI::App& program, int& exit_code);
void add_merge(CLI::App& program, int& exit_code);
void add_info(CLI::App& program, int& exit_code);
void add_explain(CLI::App& program, int& exit_code);
void add_verify(CLI::App& program, int& exit_code);
void add_accuracy(CLI::App& program, int& exit_code);
void add_report(CLI::App& program, int& exit_code);
void add_plot(CLI::App& program, int& exit_code);
void add_export(CLI::App& program, int& exit_code);
void add_reference(CLI::App& program, int& exit_code);

}  // namespace eigentrail::app
