// Traces random families with massless freedoms whose stiffness passes zero, and compares the modes at every
// point with the whole finite spectrum.
//
//     infinity_sweep [--seeds N] [--first S]
//         both directions of N seeds from S on; a line per fault, a summary at the end
//     infinity_sweep --seed S [--scene]
//         everything about one seed; its scene with --scene
//
// Exit code 1 when anything failed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "completeness/massless_family.hpp"

namespace eigentrail::test {
namespace {

/// Prints what is wrong with one trace; with `all`, also what is not. Returns whether it passed.
bool check(const MasslessFamily& family, bool reversed, bool all, long& nodes) {
  const MasslessReport report = check_massless(family, reversed);
  nodes += report.nodes;
  if (report.problems.empty() && !all) return true;
  std::printf("seed %lu%s: %ld coordinates, %ld massless, %d points; infinite at",
              static_cast<unsigned long>(family.seed), reversed ? " reversed" : "",
              static_cast<long>(family.size()), static_cast<long>(family.massless), report.nodes);
  for (const double p : family.places_of_infinity()) std::printf(" %.10g", p);
  std::printf("\n");
  constexpr std::size_t most_lines = 6;
  for (std::size_t i = 0; i < report.problems.size() && (all || i < most_lines); ++i)
    std::printf("  %s\n", report.problems[i].c_str());
  if (report.problems.size() > most_lines && !all) std::printf("  ...\n");
  for (const std::string& note : report.notes) {
    if (all) std::printf("  note: %s\n", note.c_str());
  }
  std::fflush(stdout);
  return report.problems.empty();
}

int run(int argc, char** argv) {
  CLI::App program("Traces random families with massless freedoms in both directions.");
  std::uint64_t seeds = 100;
  std::uint64_t first = 1;
  bool scene = false;
  program.add_option("--seeds", seeds, "how many");
  program.add_option("--first", first, "the first of them");
  const CLI::Option* single = program.add_option("--seed", first, "everything about this one");
  program.add_flag("--scene", scene, "prints the scene of the seed");
  CLI11_PARSE(program, argc, argv);
  if (scene) {
    std::printf("%s", massless_family(first).scene().c_str());
    return 0;
  }
  const bool all = single->count() > 0;
  if (all) seeds = 1;
  int failed = 0;
  long nodes = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    const MasslessFamily family = massless_family(seed);
    for (const bool reversed : {false, true}) failed += !check(family, reversed, all, nodes);
  }
  std::printf("%lu traces, %d failed, %ld points\n", static_cast<unsigned long>(2 * seeds), failed, nodes);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
