#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "accuracy/grid_interpolant.hpp"
#include "accuracy/grid_loci.hpp"
#include "accuracy/spectrum_distance.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
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
  if (follows_parameter(guide.path.steps[position.step])) return true;
  return distances_from_spectrum(guide.path, position, spectrum, guide.s_ref).maxCoeff() < same_passage;
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
      const ReferenceSpectrum reference =
          reference_spectrum(problem, p, guide.guess(position), guide.path.eigenvalues_at(position));
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

namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::uint64_t sum(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

void take_counts(const RunCounts& counts, MeasuredRun& run) {
  run.factorizations =
      counts.modes.factorizations + counts.certificate_factorizations + counts.event_factorizations;
  run.spectra = counts.spectra;
  run.evaluations = sum(counts.evaluations.residual) + sum(counts.evaluations.linearization);
}

/// Updates the largest error of the run with the errors of all modes at one sample.
void take_error(const Vector& distances, double p, MeasuredRun& run) {
  const double worst = distances.size() > 0 ? distances.maxCoeff() : 0.0;
  if (run.measured == 0 || worst > run.error) {
    run.error = worst;
    run.worst_parameter = p;
  }
}

/// Measures the largest error of the dense output. A sample with another number of passages than in the
/// reference is left out: it lies between the computed parameter value of a fold and the true one.
void measure_path(const RecordedPath& path, const ReferenceSet& reference, MeasuredRun& run) {
  for (const ReferenceSample& sample : reference.samples) {
    const std::vector<PathPosition> positions = path.positions(sample.p);
    if (positions.size() != sample.passages.size()) continue;
    for (std::size_t i = 0; i < positions.size(); ++i)
      take_error(distances_from_spectrum(path, positions[i], sample.passages[i], reference.s_ref), sample.p,
                 run);
    ++run.measured;
  }
}

/// The run with its errors. Samples with several passages are left out, because a grid computes only one.
MeasuredRun measure_interpolant(const GridLoci& loci, Interpolation kind, const ReferenceSet& reference,
                                MeasuredRun run) {
  run.interpolation = kind;
  if (!loci.completed) return run;
  const GridInterpolant interpolant(loci.p[0], loci.p[1] - loci.p[0], loci.s, kind);
  for (const ReferenceSample& sample : reference.samples) {
    if (sample.passages.size() != 1) continue;
    take_error(distances_from_spectrum(interpolant(sample.p), loci.both_members, sample.passages[0],
                                       reference.s_ref),
               sample.p, run);
    ++run.measured;
  }
  return run;
}

std::vector<double> equidistant(const TraceOptions& options, int points) {
  std::vector<double> p;
  for (int i = 0; i < points; ++i) p.push_back(options.from + (options.to - options.from) * i / (points - 1));
  return p;
}

}  // namespace

MeasuredRun measure_trace(const TraceSetup& setup, const ReferenceSet& reference, int repeat) {
  MeasuredRun run;
  run.method = setup.options.certify ? Method::trace : Method::trace_uncertified;
  run.tolerance = setup.options.tolerance;
  RecordedTrace recorded(setup, {});  // not timed
  recorded.begin();
  if (recorded.writer()) {
    recorded.finish({});
    run.bytes = recorded.writer()->bytes().size();
  }
  std::vector<double> seconds;
  for (int i = 0; i < repeat; ++i) {
    const TraceResult result = trace(*setup.model, setup.options, {});
    seconds.push_back(result.seconds);
    run.completed = result.status == TraceStatus::completed;
    run.message = result.message;
    run.points = result.nodes;
    run.order = result.order;
    take_counts(result.counts, run);
  }
  run.seconds = median(seconds);
  measure_path(recorded.path(), reference, run);
  return run;
}

GridRuns measure_grid(const TraceSetup& setup, const ReferenceSet& reference, Method method, int points,
                      int repeat) {
  MeasuredRun run;
  run.method = method;
  run.tolerance = std::numeric_limits<double>::quiet_NaN();
  run.points = points;
  PathProblem problem = problem_along(*setup.model, setup.options.parameter);
  problem.s_ref = reference.s_ref;
  const ModeChoice& modes = setup.options.modes;
  const std::vector<double> p = equidistant(setup.options, points);
  GridLoci loci;
  std::vector<double> seconds;
  for (int i = 0; i < repeat; ++i) {
    const StageTimer timer(seconds.emplace_back());
    loci = method == Method::qz ? qz_grid(problem, p, modes) : corrected_grid(problem, p, modes, method);
  }
  run.seconds = median(seconds);
  run.completed = loci.completed;
  run.message = loci.message;
  take_counts(loci.counts, run);
  return {measure_interpolant(loci, Interpolation::linear, reference, run),
          measure_interpolant(loci, Interpolation::cubic_spline, reference, run)};
}

}  // namespace eigentrail
