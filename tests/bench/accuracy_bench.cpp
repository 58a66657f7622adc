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

  double per_mode_step() const { return factorizations / std::max(1.0, mode_steps); }
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

template <class Value>
double quantile(const std::vector<Run>& runs, double share, Value&& value) {
  std::vector<double> values;
  for (const Run& run : runs) values.push_back(value(run));
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

template <class Value>
const Run& worst(const std::vector<Run>& runs, Value&& value) {
  return *std::max_element(runs.begin(), runs.end(),
                           [&](const Run& a, const Run& b) { return value(a) < value(b); });
}

Figures factorization_figures(const std::vector<Run>& runs) {
  std::vector<Run> fine;
  double factorizations = 0.0, mode_steps = 0.0;
  for (const Run& run : runs) {
    if (run.tolerance > 2e-6) continue;
    fine.push_back(run);
    factorizations += run.factorizations;
    mode_steps += run.mode_steps;
  }
  const auto value = [](const Run& run) { return run.per_mode_step(); };
  const Run& most = worst(fine, value);
  return {{"LU per mode and accepted step, tolerance <= 1e-6, all runs together", factorizations / mode_steps,
           at_most(1.10), short_text(mode_steps) + " mode steps"},
          {"the same, median run", quantile(fine, 0.5, value), {}},
          {"the same, 95 % of the runs",
           quantile(fine, 0.95, value),
           {},
           "most: " + short_text(value(most)) + ", " + most.text()}};
}

}  // namespace

Figures accuracy_and_factorizations(const BenchOptions& options) {
  std::vector<Run> runs;
  for (const HardCase& hard_case : cases(options)) {
    for (Run& run : runs_of(hard_case, options)) runs.push_back(std::move(run));
  }
  const auto error = [](const Run& run) { return run.error; };
  const Run& largest = worst(runs, error);
  std::string ended;
  for (const Run& run : runs) {
    if (!run.completed) ended += (ended.empty() ? "; ended early: " : ", ") + run.text();
  }
  Figures figures{{"error / tolerance, 95 % of the runs", quantile(runs, 0.95, error), at_most(2.0),
                   std::to_string(runs.size()) + " runs at 1e-4, 1e-6, 1e-8, 1e-10" + ended},
                  {"error / tolerance, largest", error(largest), at_most(4.0), largest.text()}};
  for (Figure& figure : factorization_figures(runs)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace eigentrail::test
