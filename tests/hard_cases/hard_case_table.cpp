// Prints the figures of docs/developers/hard_cases.md: every hard case at several tolerances, directions
// and first steps.
//
//     hard_case_table [--rivals] [--samples N] [--first-steps a,b,...] [name ...]
//     hard_case_table --scene name
//
// First steps are shares of the range, 0 the program's own; names may be beginnings of names. What does not
// hold is printed on stderr, a line per run. Exit code 0: everything holds; 1: something does not; 2: bad
// usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "hard_cases/rivals.hpp"
#include "hard_cases/run_case.hpp"

namespace eigentrail::test {
namespace {

void print_problems(const std::string& name, const RunSetting& setting, const CaseReport& report) {
  if (report.passed()) return;
  std::fprintf(stderr, "%s tol %g %s first %g: ", name.c_str(), setting.tolerance,
               setting.reversed ? "down" : "up", setting.first_step);
  if (!report.completed) std::fprintf(stderr, "ended early: %s; ", report.message.c_str());
  if (report.worst_error > 4.0)
    std::fprintf(stderr, "error %.3g tolerances at %.15g; ", report.worst_error, report.worst_at);
  if (report.wrong_labels > 0)
    std::fprintf(stderr, "%d of %d labels wrong; ", report.wrong_labels, report.labels);
  if (report.most_retrackings > 4) std::fprintf(stderr, "%d points for one event; ", report.most_retrackings);
  for (const std::string& event : report.missing) std::fprintf(stderr, "missing %s; ", event.c_str());
  for (const std::string& event : report.invented) std::fprintf(stderr, "invented %s; ", event.c_str());
  std::fprintf(stderr, "\n");
}

struct TableOptions {
  bool rivals = false;
  int samples = 500;                                    ///< random parameters, >= 0
  std::vector<double> first_steps{0, 1e-3, 0.03, 0.3};  ///< shares of the range, 0 <= . <= 1; 0: automatic
  std::vector<std::string> names;                       ///< beginnings of names; none: all cases
  std::string scene;                                    ///< print the scene of this case and nothing else
};

/// One line per tolerance: the worst over both directions and all first steps.
bool print_case(const HardCase& hard_case, const TableOptions& options) {
  const CaseReference reference = make_reference(hard_case, options.samples);
  bool passed = true;
  int nodes_at_middle = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    CaseReport worst;
    worst.completed = true;
    for (const bool reversed : {false, true}) {
      for (const double first_step : options.first_steps) {
        const RunSetting setting{tolerance, reversed, first_step};
        const CaseReport report = check_case(reference, trace_case(hard_case, setting), tolerance);
        print_problems(hard_case.name, setting, report);
        passed = passed && report.passed();
        worst.completed = worst.completed && report.completed;
        worst.nodes = std::max(worst.nodes, report.nodes);
        worst.lu_per_mode_step = std::max(worst.lu_per_mode_step, report.lu_per_mode_step);
        worst.worst_error = std::max(worst.worst_error, report.worst_error);
        worst.expected_events = report.expected_events;
        worst.found_events =
            worst.labels == 0 ? report.found_events : std::min(worst.found_events, report.found_events);
        worst.uncertified_share = std::max(worst.uncertified_share, report.uncertified_share);
        worst.wrong_labels = std::max(worst.wrong_labels, report.wrong_labels);
        worst.labels = std::max({worst.labels, report.labels, 1});
      }
    }
    if (tolerance == 1e-6) nodes_at_middle = worst.nodes;
    std::printf("| %s | %.0e | %d | %.2f | %.2g | %d/%d | %.2g %% | %d |%s\n", hard_case.name.c_str(),
                tolerance, worst.nodes, worst.lu_per_mode_step, worst.worst_error, worst.found_events,
                worst.expected_events, 100.0 * worst.uncertified_share, worst.wrong_labels,
                worst.completed ? "" : " ended early");
    std::fflush(stdout);
  }
  if (!options.rivals) return passed;
  const GridSpectra grid = spectra_on_grid(hard_case, 4 * nodes_at_middle);
  std::printf("rivals of %s on %d points:", hard_case.name.c_str(), 4 * nodes_at_middle);
  for (const Carrier carrier : {Carrier::nearest, Carrier::assignment, Carrier::assurance}) {
    const WrongLabels wrong = count_wrong_labels(hard_case, carry_labels(grid, carrier));
    std::printf(" %d of %d tracks,", wrong.wrong_tracks, wrong.tracks);
  }
  std::printf("%s\n", grid.complete ? "" : " stopped early");
  return passed;
}

bool wanted(const HardCase& hard_case, const TableOptions& options) {
  const auto begins = [&](const std::string& name) { return hard_case.name.starts_with(name); };
  return options.names.empty() || std::any_of(options.names.begin(), options.names.end(), begins);
}

bool print_table(const TableOptions& options) {
  std::printf(
      "| case | tolerance | points | LU per mode and step | worst error / tolerance | events found | "
      "uncertified | wrong labels |\n|---|---|---|---|---|---|---|---|\n");
  bool passed = true;
  for (const HardCase& hard_case : hard_cases()) {
    if (wanted(hard_case, options)) passed = print_case(hard_case, options) && passed;
  }
  return passed;
}

int run(int argc, char** argv) {
  CLI::App program("Traces the hard cases and prints their figures.");
  TableOptions options;
  program.add_flag("--rivals", options.rivals, "errors of the usual methods as well");
  program.add_option("--samples", options.samples, "random parameters of each case")
      ->check(CLI::NonNegativeNumber);
  program.add_option("--first-steps", options.first_steps, "shares of the range; 0: the program's own")
      ->delimiter(',')
      ->check(CLI::Range(0.0, 1.0));
  program.add_option("--scene", options.scene, "prints the scene of this case and nothing else");
  program.add_option("names", options.names, "beginnings of names; none: all cases");
  try {
    program.parse(argc, argv);
    if (!options.scene.empty()) {
      std::printf("%s", hard_case(options.scene).scene.c_str());
      return 0;
    }
    const auto any = [&](const HardCase& hard_case) { return wanted(hard_case, options); };
    if (std::none_of(hard_cases().begin(), hard_cases().end(), any))
      throw CLI::ValidationError("names", "no case of that name");
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const std::out_of_range& error) {
    std::fprintf(stderr, "hard_case_table: %s\n", error.what());
    return 2;
  }
  return print_table(options) ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
