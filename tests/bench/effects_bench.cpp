// An effect that the scene does not name costs nothing.
#include <algorithm>

#include "bench/benchmarks.hpp"
#include "bench/families.hpp"
#include "bench/text.hpp"
#include "bench/timed_trace.hpp"
#include "bench/timing.hpp"

namespace eigentrail::test {
namespace {

/// Evaluations of one effect during a trace.
std::uint64_t evaluations(const Setting& setting, const TraceResult& result, const std::string& effect) {
  const auto& effects = setting.model->description().effects;
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].name == effect)
      sum += result.counts.evaluations.residual[i] + result.counts.evaluations.linearization[i];
  }
  return sum;
}

/// Time of the series of residual and linearization at the scene's guess.
double evaluation_seconds(const Setting& setting) {
  const PathProblem problem = setting.problem();
  Path path;
  path.parameters = Matrix::Zero(problem.parameters.size(), 2);
  path.parameters.col(0) = parameters_at(problem, setting.options.from);
  path.parameters(problem.traced, 1) = 1.0;
  path.x = setting.model->initial_guess(path.parameters.col(0));
  path.lambda = Vector::Ones(setting.model->n_constraints());
  EvaluationCounts counts = setting.model->new_counts();
  SteadyResidual residual;
  Linearization linearization;
  return median_seconds(5, [&] {
    for (int i = 0; i < 60; ++i) {
      setting.model->residual(path, problem.order + 1, residual, counts);
      setting.model->linearize(path, problem.order + 1, linearization, counts);
    }
  });
}

}  // namespace

Figures absent_effects(const BenchOptions& options) {
  const Setting whole = chain_without("");
  std::uint64_t absent = 0, present = 0;
  double worst_evaluation = 0.0, worst_trace = 0.0;
  std::string text, trace_text;
  for (const std::string& effect : chain_effects()) {
    const Setting without = chain_without(effect);
    Rounds evaluation, points;
    for (int i = 0; i < options.repeats; ++i)
      evaluation.add({evaluation_seconds(without), evaluation_seconds(whole)});
    TimedTrace trace, whole_trace;
    for (int i = 0; i < 5 * options.repeats; ++i) {
      trace = time_trace(without, without.options);
      whole_trace = time_trace(whole, whole.options);
      points.add({trace.seconds / trace.result.nodes, whole_trace.seconds / whole_trace.result.nodes});
    }
    absent += evaluations(without, trace.result, effect);
    present += evaluations(whole, whole_trace.result, effect);
    const double ratio = evaluation.ratio(0, 1);
    const double trace_ratio = points.ratio(0, 1);
    worst_evaluation = std::max(worst_evaluation, ratio);
    worst_trace = std::max(worst_trace, trace_ratio);
    text += (text.empty() ? "" : ", ") + effect + " " + short_text(ratio);
    trace_text += (trace_text.empty() ? "" : ", ") + effect + " " + short_text(trace_ratio);
  }
  return {{"evaluations of effects that the scene lacks", static_cast<double>(absent), at_most(0.0),
           std::to_string(present) + " where it has them"},
          {"evaluation time without an effect / with all, largest", worst_evaluation, at_most(1.0), text},
          {"time per point of a trace, the same", worst_trace, {}, trace_text}};
}

}  // namespace eigentrail::test
