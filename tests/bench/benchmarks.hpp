// The benchmarks of the performance suite. Each measures one or a few figures; none asserts anything.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/figure.hpp"

namespace eigentrail::test {

struct BenchOptions {
  bool smoke = false;  ///< small sizes that take seconds: a test that everything runs, without valid figures
  int repeats = 5;     ///< repetitions of every timed run, >= 1; medians are reported
};

using Figures = std::vector<Figure>;

struct Benchmark {
  std::string name;  ///< for --only
  std::function<Figures(const BenchOptions&)> run;
};

// accuracy_bench.cpp
Figures accuracy_and_factorizations(const BenchOptions& options);
// step_time_bench.cpp
Figures step_time(const BenchOptions& options);
Figures growth(const BenchOptions& options);
Figures symmetric(const BenchOptions& options);
Figures threads(const BenchOptions& options);
// first_order_bench.cpp
Figures first_order(const BenchOptions& options);
// rival_bench.cpp
Figures rotating_mass(const BenchOptions& options);
Figures veerings(const BenchOptions& options);
Figures few_modes(const BenchOptions& options);
// tolerance_bench.cpp
Figures tolerance(const BenchOptions& options);
Figures order(const BenchOptions& options);
// order_bench.cpp
Figures order_choice(const BenchOptions& options);
// chain_bench.cpp
Figures chains(const BenchOptions& options);
Figures blades(const BenchOptions& options);
// large_bench.cpp
Figures large_models(const BenchOptions& options);
Figures largest_models(const BenchOptions& options);
// crossover_bench.cpp
Figures crossover(const BenchOptions& options);
// physics_bench.cpp
Figures physics(const BenchOptions& options);

/// All benchmarks, in the order of the table.
const std::vector<Benchmark>& benchmarks();

}  // namespace eigentrail::test
