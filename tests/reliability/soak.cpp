// Runs random traces in one process, each written, read back and evaluated. The memory of the process must
// not grow. Intended for a build with address sanitizer (bootstrap check), which also detects leaks.
//
//     soak [SECONDS] [SEED]      at least this time and `least_traces` traces
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "eigentrail/store/loci_file.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

constexpr double warm_up = 0.25;        ///< share of the run in which memory may grow
constexpr double allowed_growth = 0.1;  ///< largest relative growth after that
constexpr double least_traces = 160;    ///< with fewer the growth of memory is not significant

/// Resident memory of this process, bytes.
double memory() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

using Random = std::mt19937;

std::string matrix(Random& random, int n, double diagonal, double spread, bool symmetric) {
  std::normal_distribution<double> normal(0.0, spread);
  Matrix values(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) values(i, j) = normal(random) + (i == j ? diagonal * (1 + i) : 0.0);
  }
  if (symmetric) values = (0.5 * (values + values.transpose())).eval();
  std::ostringstream text;
  for (int i = 0; i < n; ++i) {
    text << (i == 0 ? "[[" : ", [");
    for (int j = 0; j < n; ++j) text << (j == 0 ? "" : ", ") << values(i, j);
    text << "]";
  }
  return text.str() + "]";
}

std::string random_family(Random& random) {
  const int n = std::uniform_int_distribution<int>(1, 8)(random);
  const bool circulatory = random() % 2 == 0;
  return "[trace]\nparameter = \"p\"\nfrom = 0\nto = 1\ntolerance = 1e-6\n[matrix_family]\nM = [" +
         matrix(random, n, 1.0, 0.0, true) + "]\nC = [" + matrix(random, n, 0.05, 0.05, false) + "]\nK = [" +
         matrix(random, n, 3.0, 0.3, true) + ", " + matrix(random, n, 0.0, 1.0, !circulatory) + "]\n";
}

Setting random_setting(Random& random) {
  static const char* const scenes[] = {"rotating_mass", "flap_lag", "jeffcott", "ziegler_links",
                                       "sleeping_top"};
  const std::size_t kind = random() % 8;
  if (kind >= std::size(scenes)) return make_setting(random_family(random));
  const double tolerance = std::pow(10.0, -4.0 - static_cast<double>(random() % 5));
  std::ostringstream text;
  text << tolerance;
  return scene_setting(scenes[kind], {{"tolerance", text.str()}});
}

/// Traces with a file, saved at every point, and reads it back. Returns the number of its points.
std::size_t trace_once(const Setting& setting, const std::string& path) {
  std::optional<LociWriter> writer;
  TraceStart start;
  TraceObserver observer;
  observer.started = [&](const TraceStart& known) { start = known; };
  observer.point = [&](const TracePoint& point) {
    if (!writer)
      writer.emplace(path, setting.scene, *setting.model, setting.options, start, point,
                     SaveOptions{0.0, Existing::replace});
    writer->append(point);
    return true;
  };
  observer.checkpoint = [&](const Checkpoint& checkpoint) {
    writer->checkpoint(checkpoint);
    return true;
  };
  const TraceResult result = trace(*setting.model, setting.options, observer);
  if (!writer) return 0;
  writer->finish(result, {});
  const LociFile loci = read_loci(path);
  static_cast<void>(loci.eigenvalues_at(0.5 * (loci.lowest() + loci.highest())));
  return loci.n_nodes();
}

int soak(double seconds, unsigned seed) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("eigentrail-soak-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  Random random(seed);
  const auto begin = std::chrono::steady_clock::now();
  double warm = 0.0, largest = 0.0;
  double passed = 0.0;
  long traces = 0, points = 0;
  for (double share = 0.0; share < 1.0;) {
    points += static_cast<long>(trace_once(random_setting(random), folder / "out.h5"));
    ++traces;
    passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    share = std::min(passed / seconds, static_cast<double>(traces) / least_traces);
    double& peak = share < warm_up ? warm : largest;
    peak = std::max(peak, memory());
  }
  std::filesystem::remove_all(folder);
  std::printf(
      "%ld traces, %ld points in %.0f s; memory at most %.1f MB in the first quarter, %.1f MB after it\n",
      traces, points, passed, 1e-6 * warm, 1e-6 * largest);
  return largest > (1.0 + allowed_growth) * warm + 1e6 ? 1 : 0;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::soak(argc > 1 ? std::atof(argv[1]) : 900.0,
                                argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1U);
}
