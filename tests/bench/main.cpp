// The performance suite: measures every figure in one process and prints a table
// (docs/developers/performance.md).
//
//     eigentrail_bench [--only NAME ...] [--smoke] [--repeats N] [--json FILE]
//
// Exit code 0 when everything was measured, whatever the figures; 2: bad usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>

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
Figures measure(const std::vector<std::string>& only, const BenchOptions& options) {
  Figures all;
  write_table_head(std::cout);
  for (const Benchmark& benchmark : benchmarks()) {
    const bool wanted = only.empty() || std::find(only.begin(), only.end(), benchmark.name) != only.end();
    if (!wanted) continue;
    std::cerr << benchmark.name << " ..." << std::endl;
    Figures figures = benchmark.run(options);
    for (Figure& figure : figures) figure.benchmark = benchmark.name;
    write_table_lines(figures, std::cout);
    std::cout.flush();
    std::move(figures.begin(), figures.end(), std::back_inserter(all));
  }
  return all;
}

int run(int argc, char** argv) {
  CLI::App program("Measures the performance suite; prints a table.");
  BenchOptions options;
  std::vector<std::string> only;
  std::string json;
  program.add_option("--only", only, "these benchmarks")->check(CLI::IsMember(names()));
  program.add_flag("--smoke", options.smoke, "small sizes that take seconds; the figures mean nothing");
  program.add_option("--repeats", options.repeats, "of every timed run; medians are printed")
      ->check(CLI::PositiveNumber);
  program.add_option("--json", json, "write the figures to this file as well");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  if (options.smoke) options.repeats = 1;
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  const Figures figures = measure(only, options);
  if (json.empty()) return 0;
  std::ofstream file(json);
  write_json(figures, options.smoke, file);
  if (file.flush()) return 0;
  std::cerr << "eigentrail_bench: " << json << ": cannot be written\n";
  return 2;
}

}  // namespace
}  // namespace eigentrail::test

int main(int argc, char** argv) {
  return eigentrail::test::run(argc, argv);
}
