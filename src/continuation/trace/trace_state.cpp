#include "continuation/trace/trace_state.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Error of the coefficients of a series, as a share of the tolerance: the dense output multiplies them by
/// powers of the step up to the fourth, against the first.
constexpr double series_share = 1e-5;
constexpr double series_rounding = 1e-15;
/// Error of a mode that stands without correction, as a share of the tolerance.
constexpr double passing_share = 0.01;
/// A block pays where its members would need steps shorter by this factor.
constexpr double parting_share = 0.7;

}  // namespace

PathProblem trace_problem(const Model& model, const TraceOptions& options, BasisChoice basis) {
  PathProblem problem = problem_along(model, options.parameter);
  for (const auto& [name, value] : options.values)
    problem.parameters[model.description().parameters.index(name).value()] = value;
  problem.basis = basis;
  problem.threads = options.threads;
  problem.thresholds = options.thresholds;
  problem.corrector.passing_error = passing_share * options.tolerance;
  problem.corrector.series_accuracy = std::max(series_share * options.tolerance, series_rounding);
  return problem;
}

void apply(const TraceSettings& settings, PathProblem& problem) {
  problem.order = settings.order;
  problem.s_ref = settings.s_ref;
  problem.s_max = settings.s_max;
  problem.route = settings.route;
}

double parting_reach(const TraceOptions& options, int order) {
  return parting_share * std::pow(options.tolerance, -1.0 / (2.0 * order + 2.0));
}

}  // namespace eigentrail
