// Traces families with planted special points, one per seed, and prints what failed.
//
//     property_sweep [--seeds N] [--from S]     table over N seeds from S on; a line per seed that fails
//     property_sweep --seed S [--scene]         everything about one seed; its scene with --scene
//
// Exit code 1 when anything failed.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <string>

#include "eigentrail/core/text.hpp"
#include "properties/run_family.hpp"

namespace eigentrail::test {
namespace {

void print_seed(const PlantedFamily& family, const FamilyReport& report) {
  std::printf("%s", family.description().c_str());
  std::printf(
      "  tolerance %g, %s, first step %g of the range: %d points, certified %.4g %%, worst error %.3g "
      "tolerances, %d of %d events, %d labels\n",
      report.setting.tolerance, report.setting.reversed ? "down" : "up", report.setting.first_step,
      report.nodes, 100.0 * report.certified_share, report.accuracy.worst_error, report.events.found,
      report.events.expected, report.labels.labels);
  for (const std::string& place : report.labels.wrong_places) std::printf("  %s\n", place.c_str());
  std::printf("  %s\n", report.passed() ? "passed" : report.problems().c_str());
}

/// The sums over the seeds.
struct Summary {
  int seeds = 0, failed = 0, silent_swaps = 0;
  long labels = 0, nodes = 0;
  double worst_error = 0.0, least_certified = 1.0;
  std::map<std::string, KindCount> kinds;
  std::map<std::string, int> failures;  ///< seeds by what failed

  void add(const FamilyReport& report) {
    ++seeds;
    failed += !report.passed();
    silent_swaps += report.labels.wrong;
    labels += report.labels.labels;
    nodes += report.nodes;
    worst_error = std::max(worst_error, report.accuracy.worst_error);
    least_certified = std::min(least_certified, report.certified_share);
    for (const auto& [kind, count] : report.kinds) {
      kinds[kind].planted += count.planted;
      kinds[kind].found += count.found;
      kinds[kind].invented += count.invented;
    }
    for (const std::string& failure : report.failures()) ++failures[failure];
  }

  void print(double seconds) const {
    std::printf("\n| special points | planted | found | invented |\n|---|---|---|---|\n");
    for (const auto& [kind, count] : kinds)
      std::printf("| %s | %d | %d | %d |\n", kind.c_str(), count.planted, count.found, count.invented);
    std::printf("\n| failure | seeds |\n|---|---|\n");
    for (const auto& [failure, count] : failures) std::printf("| %s | %d |\n", failure.c_str(), count);
    std::printf(
        "\n%d seeds, %d failed; %d of %ld certified labels wrong; worst error %.3g tolerances; least "
        "certified share %.4g %%; %ld points; %.1f s\n",
        seeds, failed, silent_swaps, labels, worst_error, 100.0 * least_certified, nodes, seconds);
  }
};

int sweep(std::uint64_t from, std::uint64_t seeds) {
  const auto start = std::chrono::steady_clock::now();
  Summary summary;
  for (std::uint64_t seed = from; seed < from + seeds; ++seed) {
    const FamilyReport report = run_family(planted_family(seed), setting_of(seed));
    summary.add(report);
    if (!report.passed()) {
      std::printf("seed %lu tol %g %s first %.3g: %s\n", static_cast<unsigned long>(seed),
                  report.setting.tolerance, report.setting.reversed ? "down" : "up",
                  report.setting.first_step, report.problems().c_str());
      std::fflush(stdout);
    }
  }
  summary.print(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return summary.failed == 0 ? 0 : 1;
}

int run(int argc, char** argv) {
  CLI::App program("Traces families with planted special points, one per seed.");
  std::uint64_t seeds = 1000;
  std::uint64_t from = 1;
  bool scene = false;
  program.add_option("--seeds", seeds, "how many");
  program.add_option("--from", from, "the first of them");
  const CLI::Option* single = program.add_option("--seed", from, "everything about this one");
  program.add_flag("--scene", scene, "prints the scene of the seed");
  CLI11_PARSE(program, argc, argv);
  if (single->count() == 0) return sweep(from, seeds);
  const PlantedFamily family = planted_family(from);
  if (scene) {
    std::printf("%s", family.as_case().scene.c_str());
    return 0;
  }
  const FamilyReport report = run_family(family, setting_of(from));
  print_seed(family, report);
  return report.passed() ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
