#include "continuation/trace/trace_state.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/family_parts.hpp"

namespace eigentrail {
namespace {

/// Relative error of every series coefficient of a single mode, as a share of the tolerance. The coefficient
/// of power k enters the dense output times h^k, k up to 4, and its error with it; the share leaves a wide
/// margin. A larger value may show in the dense output, a smaller one costs refinements.
constexpr double series_share = 1e-5;
/// Least such error: what rounding allows.
constexpr double series_rounding = 1e-15;
/// Factor in parting_reach. At a distance of 0.5 tolerance^(-1/(2q+2)) steps, a meeting allows single modes a
/// step of exactly the present length. 0.7 keeps a block together until single modes would allow steps 1.4
/// times as long. A larger value keeps blocks, which cost more, for longer; a smaller one separates blocks
/// that soon have to be joined again.
constexpr double parting_share = 0.7;

}  // namespace

PathProblem trace_problem(const Model& model, const TraceOptions& options, BasisChoice basis) {
  PathProblem problem = problem_along(model, options.parameter);
  for (const auto& [name, value] : options.values)
    problem.parameters[model.description().parameters.index(name).value()] = value;
  problem.basis = basis;
  if (basis == BasisChoice::aligned) problem.parts = parts_of_family(problem, options);
  problem.threads = options.threads;
  problem.thresholds = options.thresholds;
  problem.corrector.series_accuracy = std::max(series_share * options.tolerance, series_rounding);
  return problem;
}

double parting_reach(const TraceOptions& options, int order) {
  return parting_share * std::pow(options.tolerance, -1.0 / (2.0 * order + 2.0));
}

}  // namespace eigentrail
