// The performance suite: measures every figure in one process and prints a table
// (docs/developers/performance.md).
//
//     eigentrail_bench [--only NAME ...] [--smoke] [--repeats N]
//
// Exit code 0 when everything was measured, whatever the figures; 2: bad usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "bench/benchmarks.hpp"

extern "C" void openblas_set_num_threads(int) __attribute__((weak));  // there where LAPACK is OpenBLAS

namespace eigentrail::test {
namespace {

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const Benchmark& benchmark : benchmarks()) result.push_back(benchmark.name);
  return result;
}

/// Prints the lines of every benchmark when it is done: the whole suite takes a while.
void measure(const std::vector<std::string>& only, const BenchOptions& options) {
  write_table_head(std::cout);
  for (const Benchmark& benchmark : benchmarks()) {
    const bool wanted = only.empty() || std::find(only.begin(), only.end(), benchmark.name) != only.end();
    if (!wanted) continue;
    std::cerr << benchmark.name << " ..." << std::endl;
    write_table_lines(benchmark.name, benchmark.run(options), std::cout);
    std::cout.flush();
  }
}

int run(int argc, char** argv) {
  CLI::App program("Measures the performance suite; prints a table.");
  BenchOptions options;
  std::vector<std::string> only;
  program.add_option("--only", only, "these benchmarks")->check(CLI::IsMember(names()));
  program.add_flag("--smoke", options.smoke, "small sizes that take seconds; the figures mean nothing");
  program.add_option("--repeats", options.repeats, "of every timed run; medians are printed")
      ->check(CLI::PositiveNumber);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  if (options.smoke) options.repeats = 1;
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  measure(only, options);
  return 0;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
