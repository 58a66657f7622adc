#include <algorithm>
#include <cmath>

#include "accuracy/spectrum_distance.hpp"
#include "eigentrail/accuracy/study.hpp"

namespace eigentrail {
namespace {

/// Tolerance of the trace that gives starting values for the equilibria; tighter than these need.
constexpr double guide_tolerance = 1e-10;

/// On a path with folds the equilibrium found at p may belong to another passage of the path. It is accepted
/// if its eigenvalues differ by less than this from those of the trace, relatively.
constexpr double same_passage = 1e-3;

/// A trace with the equilibria at its nodes, which are starting values for those of the references.
struct Guide {
  RecordedPath path;
  std::vector<Vector> x, lambda;
  double s_ref = 1.0;

  EquilibriumGuess guess(const PathPosition& position) const {
    const auto between = [&](const std::vector<Vector>& nodes) {
      return Vector((1.0 - position.t) * nodes[position.step] + position.t * nodes[position.step + 1]);
    };
    return {between(x), between(lambda), false};
  }
};

Guide trace_guide(const TraceSetup& setup) {
  TraceOptions options = setup.options;
  options.tolerance = guide_tolerance;
  options.order = 3;
  Guide guide;
  PathRecorder recorder;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    recorder.append(point);
    guide.x.emplace_back(point.node.path.x.col(0));
    guide.lambda.emplace_back(point.node.path.lambda.col(0));
    return true;
  };
  const TraceResult result = trace(*setup.model, options, observer);
  if (!has_started(result.status)) throw InputError(setup.scene.path + ": " + result.message);
  guide.path = recorder.path();
  guide.s_ref = result.s_ref;
  return guide;
}

/// Whether the spectrum belongs to the passage of the guide at this position.
bool same(const Guide& guide, const PathPosition& position, const std::vector<Complex>& spectrum) {
  const PathStep& step = guide.path.steps[position.step];
  if (follows_parameter(step)) return true;
  const ComplexVector values = guide.path.eigenvalues_at(position);
  const std::vector<bool> in_block = in_blocks(step, static_cast<std::size_t>(values.size()));
  return distances_from_spectrum(values, in_block, spectrum, guide.s_ref).maxCoeff() < same_passage;
}

}  // namespace

std::vector<double> sample_parameters(const TraceOptions& options, int count) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  std::vector<double> parameters;
  for (int i = 1; i <= count; ++i) {
    const double part = std::fmod(golden * i, 1.0);
    parameters.push_back(options.from + part * (options.to - options.from));
  }
  std::sort(parameters.begin(), parameters.end());
  return parameters;
}

ReferenceSet reference_set(const TraceSetup& setup, const std::vector<double>& parameters) {
  const Guide guide = trace_guide(setup);
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.steady.relax = false;  // relaxation may lead to an equilibrium that is not on the path
  problem.s_ref = guide.s_ref;
  ReferenceSet set;
  set.s_ref = guide.s_ref;
  for (const double p : parameters) {
    ReferenceSample sample{p, {}};
    bool solved = true;
    for (const PathPosition& position : guide.path.positions(p)) {
      const ReferenceSpectrum reference = reference_spectrum(problem, p, guide.guess(position));
      sample.passages.push_back(reference.nearest_doubles());
      solved = solved && reference.status == ReferenceStatus::converged &&
               same(guide, position, sample.passages.back());
      if (solved) set.correction = std::max(set.correction, reference.correction);
    }
    if (solved && !sample.passages.empty()) {
      set.samples.push_back(std::move(sample));
    } else {
      ++set.unsolved;
    }
  }
  return set;
}

}  // namespace eigentrail
