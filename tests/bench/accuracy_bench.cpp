// Achieved error over tolerance, and LU per mode and step, on hard cases and planted families.
#include <algorithm>

#include "bench/benchmarks.hpp"
#include "bench/text.hpp"
#include "hard_cases/run_case.hpp"
#include "properties/planted_family.hpp"

namespace eigentrail::test {
namespace {

struct Run {
  std::string name;
  double tolerance = 0.0;
  bool completed = false;
  double error = 0.0;  ///< over the tolerance
  double factorizations = 0.0, mode_steps = 0.0;

  std::string text() const { return name + " at " + short_text(tolerance); }
};

std::vector<HardCase> cases(const BenchOptions& options) {
  const int seeds = options.smoke ? 2 : 40;
  std::vector<HardCase> list = hard_cases();
  if (options.smoke) list.resize(2);
  for (int seed = 1; seed <= seeds; ++seed) {
    list.push_back(planted_family(static_cast<std::uint64_t>(seed)).as_case());
    list.back().name = "seed " + std::to_string(seed);
  }
  return list;
}

std::vector<Run> runs_of(const HardCase& hard_case, const BenchOptions& options) {
  std::vector<Sample> samples;
  for (const double p : sample_parameters(hard_case, options.smoke ? 5 : 40))
    samples.push_back(sample_at(hard_case, p));
  std::vector<Run> runs;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const RecordedTrace trace = trace_case(hard_case, {tolerance});
    Run run{hard_case.name, tolerance, trace.result.status == TraceStatus::completed};
    run.factorizations = static_cast<double>(trace.result.counts.modes.factorizations);
    run.mode_steps = static_cast<double>(trace.result.mode_steps);
    if (!trace.steps.empty()) run.error = measure_accuracy(samples, trace, tolerance).worst_error;
    runs.push_back(std::move(run));
  }
  return runs;
}

/// The error that this share of the runs does not exceed.
double quantile(const std::vector<Run>& runs, double share) {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(run.error);
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

Figure factorization_figure(const std::vector<Run>& runs) {
  double factorizations = 0.0, mode_steps = 0.0;
  for (const Run& run : runs) {
    if (run.tolerance > 2e-6) continue;
    factorizations += run.factorizations;
    mode_steps += run.mode_steps;
  }
  return {"LU per mode and accepted step, tolerance <= 1e-6, all runs together", factorizations / mode_steps,
          at_most(1.10), short_text(mode_steps) + " mode steps"};
}

}  // namespace

Figures accuracy_and_factorizations(const BenchOptions& options) {
  std::vector<Run> runs;
  for (const HardCase& hard_case : cases(options)) {
    for (Run& run : runs_of(hard_case, options)) runs.push_back(std::move(run));
  }
  const Run& largest = *std::max_element(runs.begin(), runs.end(),
                                         [](const Run& a, const Run& b) { return a.error < b.error; });
  std::string ended;
  for (const Run& run : runs) {
    if (!run.completed) ended += (ended.empty() ? "; ended early: " : ", ") + run.text();
  }
  return {{"error / tolerance, 95 % of the runs", quantile(runs, 0.95), at_most(2.0),
           std::to_string(runs.size()) + " runs at 1e-4, 1e-6, 1e-8, 1e-10" + ended},
          {"error / tolerance, largest", largest.error, at_most(4.0), largest.text()},
          factorization_figure(runs)};
}

}  // namespace eigentrail::test
