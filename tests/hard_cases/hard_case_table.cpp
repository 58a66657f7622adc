// Prints the summary table of docs/hard_cases.md: every hard case at several tolerances, directions and first
// steps.
//
//     hard_case_table [--rivals] [--samples N] [name ...]
//     hard_case_table --scene name
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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
  for (const std::string& event : report.missing) std::fprintf(stderr, "missing %s; ", event.c_str());
  for (const std::string& event : report.invented) std::fprintf(stderr, "invented %s; ", event.c_str());
  std::fprintf(stderr, "\n");
}

/// One line per tolerance: the worst over both directions and all first steps.
bool print_case(const HardCase& hard_case, bool rivals, int samples) {
  const CaseReference reference = make_reference(hard_case, samples);
  bool passed = true;
  int nodes_at_middle = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    CaseReport worst;
    worst.completed = true;
    for (const bool reversed : {false, true}) {
      for (const double first_step : {0.0, 1e-3, 0.03, 0.3}) {
        const RunSetting setting{tolerance, reversed, first_step};
        const CaseReport report = run_case(reference, setting);
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
  if (!rivals) return passed;
  const GridSpectra grid = spectra_on_grid(hard_case, 4 * nodes_at_middle);
  std::printf("rivals of %s on %d points:", hard_case.name.c_str(), 4 * nodes_at_middle);
  for (const Carrier carrier : {Carrier::nearest, Carrier::assignment, Carrier::assurance}) {
    const WrongLabels wrong = count_wrong_labels(hard_case, carry_labels(grid, carrier));
    std::printf(" %d of %d tracks,", wrong.wrong_tracks, wrong.tracks);
  }
  std::printf("%s\n", grid.complete ? "" : " stopped early");
  return passed;
}

int run(int argc, char** argv) {
  bool rivals = false;
  int samples = 500;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--rivals") == 0) {
      rivals = true;
    } else if (std::strcmp(argv[i], "--samples") == 0 && i + 1 < argc) {
      samples = std::atoi(argv[++i]);
    } else if (std::strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
      std::printf("%s", hard_case(argv[i + 1]).scene.c_str());
      return 0;
    } else {
      names.emplace_back(argv[i]);
    }
  }
  std::printf(
      "| case | tolerance | points | LU per mode and step | worst error / tolerance | events found | "
      "uncertified | "
      "wrong labels |\n|---|---|---|---|---|---|---|---|\n");
  bool passed = true;
  for (const HardCase& hard_case : hard_cases()) {
    const bool wanted =
        names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& name) {
          return hard_case.name.starts_with(name);
        });
    if (wanted) passed = print_case(hard_case, rivals, samples) && passed;
  }
  return passed ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
