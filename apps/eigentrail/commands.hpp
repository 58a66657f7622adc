// The commands of the program. Each function adds its command to the command line. When the command line is
// parsed, the command that was given runs and sets `exit_code`.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "factor_team.hpp"
#include "team.hpp"

namespace eigentrail::app {

/// Exit codes of the program: success; numerical failure, after which what was computed is kept; invalid
/// input or usage.
enum ExitCode { done = 0, numbers_failed = 1, bad_input = 2 };

/// Adds a command with arguments of its own, which both live as long as the program. `run` is called with
/// them and returns the exit code.
template <class Arguments, class Run>
std::pair<CLI::App*, Arguments*> add_command(CLI::App& program, int& exit_code, Run run,
                                             const std::string& name, const std::string& description) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(name, description);
  command->callback([arguments, run, &exit_code] { exit_code = run(*arguments); });
  return {command, arguments.get()};
}

/// Runs a command in a team: `together` or `alone`.
template <class Arguments>
auto in_team(int (*run)(Arguments&, Team&), int (*team)(const std::function<int(Team&)>&)) {
  return [=](Arguments& arguments) { return team([&](Team& own) { return run(arguments, own); }); };
}

/// Runs a command that may factor large matrices.
template <class Arguments>
auto factoring(int (*run)(Arguments&, const SparseSolverMaker&)) {
  return [=](Arguments& arguments) {
    return factoring_together([&](const SparseSolverMaker& solver) { return run(arguments, solver); });
  };
}

/// A function that adds a command to the command line.
using AddCommand = void(CLI::App& program, int& exit_code);
AddCommand add_new, add_suggest, add_import, add_trace, add_spectrum, add_linearize, add_eval, add_events,
    add_boundary, add_map, add_sweep, add_merge, add_info, add_explain, add_verify, add_accuracy, add_report,
    add_plot, add_export, add_reference;

}  // namespace eigentrail::app
