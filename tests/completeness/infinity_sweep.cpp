// Traces random families with massless freedoms whose stiffness passes zero, and compares the modes at every
// point with the whole finite spectrum.
//
//     infinity_sweep [--seeds N] [--first S]
//         both directions of N seeds from S on; a line per fault, a summary at the end
//     infinity_sweep --seed S [--scene]
//         everything about one seed; its scene with --scene
//
// Exit code 1 when anything failed.
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

int usage() {
  std::fprintf(stderr, "usage: infinity_sweep [--seeds N] [--first S] | --seed S [--scene]\n");
  return 2;
}

int run(int argc, char** argv) {
  std::uint64_t seeds = 100;
  std::uint64_t first = 1;
  bool single = false;
  bool scene = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--scene") {
      scene = true;
    } else if (i + 1 == argc) {
      return usage();
    } else if (option == "--seeds") {
      seeds = std::stoull(argv[++i]);
    } else if (option == "--first" || option == "--seed") {
      first = std::stoull(argv[++i]);
      single = single || option == "--seed";
    } else {
      return usage();
    }
  }
  if (scene) {
    std::printf("%s", massless_family(first).scene().c_str());
    return 0;
  }
  if (single) seeds = 1;
  int failed = 0;
  long nodes = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    const MasslessFamily family = massless_family(seed);
    for (const bool reversed : {false, true}) failed += !check(family, reversed, single, nodes);
  }
  std::printf("%lu traces, %d failed, %ld points\n", static_cast<unsigned long>(2 * seeds), failed, nodes);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
