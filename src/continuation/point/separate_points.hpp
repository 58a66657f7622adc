// Points at single values of the traced parameter, without a trace between them.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/continuation/trace_options.hpp"

namespace eigentrail {

/// Throws InputError for a value outside the samples of the model, if it has such.
void check_within_samples(const TraceSetup& setup, const std::vector<double>& values);

/// Calls use(point) for the equilibrium and the reduced equations at each value. Where Newton's method finds
/// no equilibrium from the model's own guess it starts from the last one found: which one is found depends on
/// no other value else. `frame`, the basis to which those of the points are aligned, may be set by `use`.
template <class Use>
void for_each_point(const PathProblem& problem, const std::vector<double>& values, const Matrix& frame,
                    const Use& use) {
  RunCounts counts;
  EquilibriumGuess last;
  for (const double p : values) {
    const EquilibriumGuess own{problem.model.initial_guess(parameters_at(problem, p)), Vector(), false};
    PathPoint point = reduce_at(problem, p, own, frame, counts);
    if (point.status != PointStatus::computed && last.x.size() > 0)
      point = reduce_at(problem, p, last, frame, counts);
    if (point.status == PointStatus::computed) last = {point.equilibrium.x, point.equilibrium.lambda, true};
    use(point);
  }
}

}  // namespace eigentrail
