// Traces random families and compares their flutter, divergence and real collisions with a reference that
// follows no eigenvalue.
//
//     completeness_sweep [--seeds N] [--first S] [--reversed] [--scenes FOLDER]
//         a line per discrepancy over N seeds from S on, a table at the end; scenes of the seeds that fail
//     completeness_sweep --veerings [--seeds N] [--first S] [--reversed]
//         the same for veerings, against exceptional points at complex parameters
//     completeness_sweep --few K [--seeds N] [--first S] [--reversed]
//         traces of the K slowest modes against traces of all modes
//     completeness_sweep --seed S [--reversed] [--scene]
//         everything about one seed; its scene with --scene
//
// Exit code 1 when anything failed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "completeness/discrepancies.hpp"
#include "completeness/exceptional_points.hpp"
#include "completeness/few_modes.hpp"

namespace eigentrail::test {
namespace {

std::string title(const CompletenessReport& report) {
  return "seed " + std::to_string(report.family.seed) + ", " + name_of(report.family.kind) + ", " +
         std::to_string(report.family.size()) + " coordinates";
}

struct Count {
  int expected = 0, missing = 0, invented = 0;
};

struct Summary {
  int seeds = 0, failed = 0, with_events = 0, touching = 0;
  long spectra = 0, nodes = 0;
  double reference_seconds = 0.0, trace_seconds = 0.0;
  std::map<std::string, Count> kinds;
  std::map<std::string, std::set<std::uint64_t>> failures;  ///< seeds by what failed
  std::set<std::uint64_t> undecided;                        ///< seeds with places that are not compared
  std::map<std::string, std::pair<int, int>> of_family;     ///< failed and all, by kind of family

  void add(const CompletenessReport& report) {
    ++seeds;
    failed += !report.passed();
    with_events += !report.reference.events.empty();
    touching += static_cast<int>(report.reference.touching.size());
    spectra += report.reference.spectra;
    nodes += report.nodes;
    reference_seconds += report.reference_seconds;
    trace_seconds += report.trace_seconds;
    auto& [failed_of_family, all_of_family] = of_family[name_of(report.family.kind)];
    failed_of_family += !report.passed();
    ++all_of_family;
    for (const ReferenceEvent& event : report.reference.events) ++kinds[event.kind].expected;
    for (const Discrepancy& discrepancy : report.discrepancies) {
      failures[discrepancy.what].insert(report.family.seed);
      const std::size_t space = discrepancy.what.find(' ');
      const std::string first = discrepancy.what.substr(0, space);
      const std::string kind = discrepancy.what.substr(space + 1);
      if (first == "missing") ++kinds[kind].missing;
      if (first == "invented") ++kinds[kind].invented;
    }
    if (!report.reference.doubts.empty()) failures["reference in doubt"].insert(report.family.seed);
    if (!report.reference.touching.empty()) undecided.insert(report.family.seed);
  }

  void print() const {
    std::printf("\n| events | reference | missing | invented |\n|---|---|---|---|\n");
    for (const auto& [kind, count] : kinds)
      std::printf("| %s | %d | %d | %d |\n", kind.c_str(), count.expected, count.missing, count.invented);
    std::printf("\n| families | seeds | failed |\n|---|---|---|\n");
    for (const auto& [kind, count] : of_family)
      std::printf("| %s | %d | %d |\n", kind.c_str(), count.second, count.first);
    std::printf("\n| failure | seeds | which |\n|---|---|---|\n");
    for (const auto& [failure, which] : failures) {
      std::printf("| %s | %zu |", failure.c_str(), which.size());
      for (const std::uint64_t seed : which) std::printf(" %lu", static_cast<unsigned long>(seed));
      std::printf(" |\n");
    }
    std::printf("\nundecided somewhere, which is not compared:");
    for (const std::uint64_t seed : undecided) std::printf(" %lu", static_cast<unsigned long>(seed));
    std::printf(
        "\n%d seeds, %d with events, %d failed; %d places where the reference is undecided; reference %ld "
        "spectra, %.1f s; traces %ld points, %.1f s\n",
        seeds, with_events, failed, touching, spectra, reference_seconds, nodes, trace_seconds);
  }
};

struct Options {
  std::uint64_t seeds = 1000, first = 1;
  int few = 0;
  bool reversed = false, scene = false, veerings = false;
  std::string scenes;
};

/// In the direction of the trace.
RandomFamily traced(RandomFamily family, const Options& options) {
  if (options.reversed) std::swap(family.from, family.to);
  return family;
}

int sweep(const Options& options) {
  Summary summary;
  for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
    const RandomFamily family = random_family(seed);
    const CompletenessReport report = check_completeness(family, options.reversed);
    summary.add(report);
    if (report.passed()) continue;
    std::printf("%s\n%s", title(report).c_str(), report.problems().c_str());
    std::fflush(stdout);
    if (!options.scenes.empty())
      std::ofstream(options.scenes + "/seed_" + std::to_string(seed) + ".toml")
          << traced(family, options).scene();
  }
  summary.print();
  return summary.failed == 0 ? 0 : 1;
}

int sweep_veerings(const Options& options) {
  int expected = 0;
  int listed = 0;
  int overlooked = 0;
  std::size_t missing = 0;
  std::size_t invented = 0;
  std::set<std::uint64_t> failed;
  for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
    const CompletenessReport report = check_completeness(random_family(seed), options.reversed);
    if (!report.completed) continue;
    const VeeringComparison veerings =
        compare_veerings(report.family.matrices, report.family.from, report.family.to, report.events);
    expected += veerings.expected;
    listed += veerings.listed;
    overlooked += veerings.overlooked;
    missing += veerings.missing.size();
    invented += veerings.invented.size();
    if (veerings.missing.empty() && veerings.invented.empty()) continue;
    failed.insert(seed);
    std::printf("%s\n", title(report).c_str());
    for (const std::string& line : veerings.missing) std::printf("  %s\n", line.c_str());
    for (const std::string& line : veerings.invented) std::printf("  %s\n", line.c_str());
    std::fflush(stdout);
  }
  std::printf(
      "\n%d exceptional points, %zu missing; %d veerings listed, %zu invented, %d confirmed that the "
      "reference "
      "had overlooked; %zu seeds failed\n",
      expected, missing, listed, invented, overlooked, failed.size());
  return failed.empty() ? 0 : 1;
}

int sweep_few(const Options& options) {
  std::uint64_t failed = 0;
  long nodes = 0;
  long nodes_of_all = 0;
  for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
    const FewModesReport report = check_few_modes(random_family(seed), {options.few}, options.reversed);
    nodes += report.nodes;
    nodes_of_all += report.nodes_of_all;
    if (report.problems.empty()) continue;
    ++failed;
    std::printf("seed %lu\n", static_cast<unsigned long>(seed));
    for (const std::string& line : report.problems) std::printf("  %s\n", line.c_str());
    std::fflush(stdout);
  }
  std::printf("%lu seeds, %d modes: %lu failed; %ld points, of all modes %ld\n",
              static_cast<unsigned long>(options.seeds), options.few, static_cast<unsigned long>(failed),
              nodes, nodes_of_all);
  return failed == 0 ? 0 : 1;
}

int show(const Options& options) {
  const RandomFamily family = random_family(options.first);
  if (options.scene) {
    std::printf("%s", traced(family, options).scene().c_str());
    return 0;
  }
  const CompletenessReport report = check_completeness(family, options.reversed);
  std::printf("%s: %d points, %.2f s; reference %d spectra, %.2f s\n", title(report).c_str(), report.nodes,
              report.trace_seconds, report.reference.spectra, report.reference_seconds);
  for (const ReferenceEvent& event : report.reference.events) {
    std::printf("  reference: %s at %.12g, s %.6g + %.6gj, direction %d\n", event.kind.c_str(), event.p,
                event.s.real(), event.s.imag(), event.direction);
  }
  for (const ReferenceEvent& event : report.reference.touching)
    std::printf("  undecided: %s at %.12g\n", event.kind.c_str(), event.p);
  for (const Event& event : report.events)
    std::printf("  trace: %s, direction %d\n", event_line(event).c_str(), event.direction);
  for (const std::string& note : report.notes) std::printf("  note: %s\n", note.c_str());
  std::printf("%s", report.passed() ? "  passed\n" : report.problems().c_str());
  return report.passed() ? 0 : 1;
}

int run(int argc, char** argv) {
  CLI::App program("Traces random families and compares their events with a reference.");
  Options options;
  program.add_option("--seeds", options.seeds, "how many");
  program.add_option("--first", options.first, "the first of them");
  const CLI::Option* single = program.add_option("--seed", options.first, "everything about this one");
  program.add_option("--few", options.few, "as many of the slowest modes, against all");
  program.add_option("--scenes", options.scenes, "folder for the scenes of seeds that fail");
  program.add_flag("--veerings", options.veerings, "compares veerings");
  program.add_flag("--reversed", options.reversed, "from the other end of the range");
  program.add_flag("--scene", options.scene, "prints the scene of the seed");
  CLI11_PARSE(program, argc, argv);
  if (options.veerings) return sweep_veerings(options);
  if (options.few > 0) return sweep_few(options);
  return single->count() > 0 ? show(options) : sweep(options);
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
