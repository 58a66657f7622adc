#include "eigentrail/continuation/path_point.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/matrix_series.hpp"
#include "core/parallel.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

void size_counters(const PathProblem& problem, RunCounts& counts) {
  if (counts.evaluations.residual.empty()) counts.evaluations = problem.model.new_counts();
}

Equilibrium equilibrium_at(const PathProblem& problem, double& p, const EquilibriumGuess& guess,
                           const std::optional<PathPlane>& plane, RunCounts& counts) {
  const StageTimer timer(counts.equilibrium_seconds);
  const Vector parameters = parameters_at(problem, p);
  // A fixed equilibrium is solved once, at the start, and kept.
  if (problem.structure.known_equilibrium || (problem.structure.fixed_equilibrium && guess.solved)) {
    const Eigen::Index m = problem.model.n_constraints();
    const Vector lambda = guess.lambda.size() == m ? guess.lambda : Vector(Vector::Zero(m));
    return keep_equilibrium(problem.model, parameters, guess.x, lambda, counts.evaluations);
  }
  // On the path a failure tells of a fold or a branch point; what hangs at rest there may be another path.
  SteadyOptions steady = problem.steady;
  steady.relax = steady.relax && !guess.solved;
  Equilibrium result =
      plane ? solve_equilibrium_on(*plane, problem.model, parameters, problem.traced, guess.x, guess.lambda,
                                   problem.steady, p, counts.evaluations)
            : solve_equilibrium(problem.model, parameters, guess.x, guess.lambda, steady, counts.evaluations);
  counts.equilibrium_iterations += static_cast<std::uint64_t>(result.report.iterations);
  counts.equilibrium_factorizations += static_cast<std::uint64_t>(result.report.factorizations);
  return result;
}

/// All parameters when one of them moves away from its value at the point.
VectorSeries straight_series(const PathProblem& problem, const PathPoint& point, int parameter) {
  VectorSeries parameters = VectorSeries::Zero(problem.parameters.size(), 2);
  parameters.col(0) = parameters_at(problem, point.p);
  parameters(parameter, 1) = 1.0;
  return parameters;
}

/// Whether the equilibrium stays where it is along a series of parameters.
bool keeps_equilibrium(const Model& model, const VectorSeries& parameters) {
  for (Eigen::Index i = 0; i < parameters.rows(); ++i) {
    const bool moves = !parameters.row(i).tail(parameters.cols() - 1).isZero(0.0);
    if (moves && !model.structure(static_cast<int>(i)).fixed_equilibrium) return false;
  }
  return true;
}

/// Series of the equilibrium along `parameters`.
EvaluationFault series_along(const PathProblem& problem, const PathPoint& point,
                             const VectorSeries& parameters, int order, Path& path, RunCounts& counts) {
  if (keeps_equilibrium(problem.model, parameters)) {
    path = {parameters, point.equilibrium.x, point.equilibrium.lambda};
    return {};
  }
  return differentiate_equilibrium(problem.model, point.equilibrium, parameters, order, path,
                                   counts.evaluations);
}

/// Basis and pencil at the point's equilibrium, if there is one.
void reduce_point(const PathProblem& problem, const Matrix& previous_basis, PathPoint& point,
                  RunCounts& counts) {
  if (point.equilibrium.status != SteadyStatus::converged) {
    point.status = PointStatus::no_equilibrium;
    point.message = point.equilibrium.report.message;
    return;
  }
  const StageTimer timer(counts.reduction_seconds);
  point.basis = tangent_basis(point.equilibrium.kkt.constraints(), previous_basis);
  if (problem.basis == BasisChoice::random) randomize_basis(point.basis, std::hash<double>()(point.p));
  point.pencil = reduce(point.equilibrium.linearization, point.basis, 0);
}

/// Series of V = T Z.
std::vector<ComplexMatrix> physical_series(const TangentBasis& basis, std::vector<ComplexMatrix> Z) {
  if (basis.is_identity) return Z;
  std::vector<ComplexMatrix> T;
  for (const Matrix& coefficient : basis.T) T.emplace_back(coefficient.cast<Complex>());
  return multiply_series(T, Z, Z.size());
}

/// Calls work(i, counts) for every mode, in `threads` at once; the counts are those of all.
template <class Work>
void for_every_mode(const PathProblem& problem, std::size_t modes, Eigen::Index n, ModeCounts& counts,
                    Work&& work) {
  std::vector<ModeCounts> own(modes);
  in_parallel(modes, is_worth_sharing(modes, n) ? problem.threads : 1,
              [&](std::size_t i) { work(i, own[i]); });
  for (const ModeCounts& some : own) counts += some;
}

/// The pairs at a reduced point one by one from their predictions.
class ModeCorrections {
 public:
  ModeCorrections(const PathProblem& problem, const Prediction& prediction, PathPoint& point)
      : problem_(problem),
        prediction_(prediction),
        point_(point),
        projection_(point.basis.is_identity ? Matrix() : Matrix(point.basis.T[0].transpose())),
        finite_(point.pencil, Chart::finite),
        reciprocal_(point.pencil, Chart::reciprocal) {
    point.pairs.resize(prediction.pairs.size());
    point.passed.resize(prediction.pairs.size());
    point.ready = prediction.ready;
  }

  void correct(std::size_t i, ModeCounts& counts) {
    if (i < prediction_.ready.size() && prediction_.ready[i] != nullptr) {
      point_.pairs[i] = prediction_.ready[i]->pair;
      return;
    }
    InvariantPair start = reduced(prediction_.pairs[i]);
    const PencilAtPoint& pencil = start.chart == Chart::finite ? finite_ : reciprocal_;
    const double reference = problem_.reference(start.chart);
    if (i < prediction_.continued.size() && prediction_.continued[i]) {
      InvariantPair other = reduced(prediction_.continued[i]->pair);
      normalize_pair(other.Z, other.Lambda, other.W, reference);
      other.backward_error = backward_error(pencil, other);
      if (prediction_.continued[i]->may_pass &&
          other.condition * other.backward_error <= problem_.corrector.passing_error) {
        other.status = PairStatus::converged;
        point_.pairs[i] = std::move(other);
        point_.passed[i] = prediction_.continued[i]->series;
        ++counts.passed;
        return;
      }
      if (other.backward_error < backward_error(pencil, start)) start = std::move(other);
    }
    point_.pairs[i] = correct_pair(pencil, start, reference, problem_.corrector, counts);
  }

  std::vector<InvariantPair> starts() const {
    std::vector<InvariantPair> all;
    for (const InvariantPair& pair : prediction_.pairs) all.push_back(reduced(pair));
    return all;
  }

  const PencilAtPoint& finite() const { return finite_; }

 private:
  InvariantPair reduced(InvariantPair pair) const {
    if (projection_.size() > 0) pair.Z = multiply(projection_, pair.Z);
    return pair;
  }

  const PathProblem& problem_;
  const Prediction& prediction_;
  PathPoint& point_;
  Matrix projection_;  ///< T^T; empty where T is the identity
  PencilAtPoint finite_, reciprocal_;
};

/// Corrects the predicted pairs at a reduced point, all at once or one by one.
void correct_modes(const PathProblem& problem, const Prediction& prediction, PathPoint& point,
                   RunCounts& counts) {
  const StageTimer timer(counts.modes_seconds);
  ModeCorrections corrections(problem, prediction, point);
  if (problem.all_at_once && is_complete(prediction.pairs, point.pencil.size())) {
    point.all = correct_all(corrections.finite(), corrections.starts(), problem.reference(Chart::finite),
                            problem.corrector, counts.modes, point.pairs);
    if (point.all) {
      point.ready.clear();
      return;
    }
    point.pairs.resize(prediction.pairs.size());
  }
  for_every_mode(problem, point.pairs.size(), point.pencil.size(), counts.modes,
                 [&](std::size_t i, ModeCounts& own) { corrections.correct(i, own); });
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    if (point.pairs[i].status == PairStatus::converged) continue;
    point.status = PointStatus::mode_lost;
    point.lost_track = static_cast<int>(i);
    point.message = "the corrector did not converge";
    return;
  }
}

/// A track of a corrected pair and its series in physical coordinates.
Track make_track(InvariantPair pair, PairSeries series) {
  Track track;
  track.pair = std::move(pair);
  track.functions = block_functions(series.Lambda);
  track.roots = pair_eigenvalues(track.pair);
  track.modes.assign(static_cast<std::size_t>(track.size()), Track::no_mode);
  track.series = std::move(series);
  return track;
}

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          ModeCounts& counts) {
  PairSeries series =
      differentiate_pair(node.pencil, pair, problem.order + 1, counts, problem.corrector.series_accuracy);
  series.Z = physical_series(node.basis, std::move(series.Z));
  return make_track(std::move(pair), std::move(series));
}

/// The track of pair i of a point, from what is known of it.
Track track_at(const PathProblem& problem, const PathNode& node, const PathPoint& point, std::size_t i,
               ModeCounts& counts) {
  if (i < point.ready.size() && point.ready[i] != nullptr) {
    Track track = make_track(point.ready[i]->pair, point.ready[i]->series);
    track.passed = point.ready[i]->passed;
    return track;
  }
  if (i >= point.passed.size() || !point.passed[i])
    return differentiate_track(problem, node, point.pairs[i], counts);
  Track track = make_track(point.pairs[i], *point.passed[i]);
  track.passed = true;
  return track;
}

bool is_finite(const Track& track) {
  return track.functions.allFinite() && std::all_of(track.series.Z.begin(), track.series.Z.end(),
                                                    [](const auto& Z) { return Z.allFinite(); });
}

}  // namespace

bool is_worth_sharing(std::size_t modes, Eigen::Index n) {
  constexpr double least_work = 3e5;  // modes n^3; a thread costs some 20 us
  const auto size = static_cast<double>(n);
  return static_cast<double>(modes) * size * size * size > least_work;
}

ComplexMatrix PathPoint::shapes(std::size_t pair) const {
  return basis.is_identity ? pairs[pair].Z : ComplexMatrix(basis.T[0].cast<Complex>() * pairs[pair].Z);
}

PathProblem problem_along(const Model& model, const std::string& parameter) {
  PathProblem problem{model, model.description().parameters.index(parameter).value()};
  problem.parameters = model.description().parameters.declared_values();
  problem.structure = model.structure(problem.traced);
  return problem;
}

Vector parameters_at(const PathProblem& problem, double p) {
  Vector parameters = problem.parameters;
  parameters[problem.traced] = p;
  return parameters;
}

PathPoint reduce_at(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                    const Matrix& previous_basis, RunCounts& counts, const std::optional<PathPlane>& plane) {
  size_counters(problem, counts);
  PathPoint point;
  point.plane = plane;
  point.equilibrium = equilibrium_at(problem, p, guess, plane, counts);
  point.p = p;
  reduce_point(problem, previous_basis, point, counts);
  return point;
}

PathPoint reduce_on(const PathProblem& problem, const Path& known, const Matrix& previous_basis,
                    RunCounts& counts) {
  size_counters(problem, counts);
  PathPoint point;
  point.known = known;
  point.p = known.parameters(problem.traced, 0);
  point.equilibrium = keep_equilibrium(problem.model, known.parameters.col(0), known.x.col(0),
                                       known.lambda.col(0), counts.evaluations);
  reduce_point(problem, previous_basis, point, counts);
  return point;
}

EvaluationFault equilibrium_series(const PathProblem& problem, const PathPoint& point, int order, Path& path,
                                   RunCounts& counts) {
  if (point.known) {
    path = *point.known;
    return {};
  }
  if (!point.plane) {
    const VectorSeries parameters = straight_series(problem, point, problem.traced);
    return series_along(problem, point, parameters, order, path, counts);
  }
  return differentiate_equilibrium_on(*point.plane, problem.model, point.equilibrium,
                                      parameters_at(problem, point.p), problem.traced, order, path,
                                      counts.evaluations);
}

PathPoint compute_point(const PathProblem& problem, const Prediction& prediction,
                        const Matrix& previous_basis, RunCounts& counts) {
  PathPoint point = prediction.known ? reduce_on(problem, *prediction.known, previous_basis, counts)
                                     : reduce_at(problem, prediction.p, prediction.equilibrium,
                                                 previous_basis, counts, prediction.plane);
  if (point.status != PointStatus::computed) return point;
  if (point.pencil.size() != previous_basis.cols()) {
    point.status = PointStatus::no_equilibrium;
    point.message = "the number of independent constraints changed";
    return point;
  }
  correct_modes(problem, prediction, point, counts);
  return point;
}

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts) {
  return differentiate_track(problem, node, std::move(pair), counts.modes);
}

namespace {

/// What follows from the path of a node that has one.
std::optional<PathNode> differentiate_along(const PathProblem& problem, const PathPoint& point, PathNode node,
                                            RunCounts& counts) {
  const int order = problem.order + 1;
  node.p = point.p;
  if (problem.model.linearize(node.path, order, node.linearization, counts.evaluations)) return std::nullopt;
  node.basis = point.basis;
  differentiate_basis(point.equilibrium.kkt.constraints(), node.linearization.A, order, node.basis);
  node.pencil = reduce(node.linearization, node.basis, order);
  if (point.all) {
    std::vector<PairSeries> series =
        differentiate_all(node.pencil, *point.all, order, problem.corrector.series_accuracy, counts.modes);
    for (std::size_t i = 0; i < point.pairs.size(); ++i) {
      series[i].Z = physical_series(node.basis, std::move(series[i].Z));
      node.tracks.push_back(make_track(point.pairs[i], std::move(series[i])));
    }
  } else {
    node.tracks.resize(point.pairs.size());
    for_every_mode(
        problem, point.pairs.size(), node.pencil.size(), counts.modes,
        [&](std::size_t i, ModeCounts& own) { node.tracks[i] = track_at(problem, node, point, i, own); });
  }
  if (!std::all_of(node.tracks.begin(), node.tracks.end(), is_finite)) return std::nullopt;
  return node;
}

}  // namespace

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            RunCounts& counts) {
  size_counters(problem, counts);
  const StageTimer timer(counts.differentiation_seconds);
  PathNode node;
  if (equilibrium_series(problem, point, problem.order + 1, node.path, counts)) return std::nullopt;
  return differentiate_along(problem, point, std::move(node), counts);
}

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            const VectorSeries& parameters, RunCounts& counts) {
  size_counters(problem, counts);
  const StageTimer timer(counts.differentiation_seconds);
  PathNode node;
  if (series_along(problem, point, parameters, problem.order + 1, node.path, counts)) return std::nullopt;
  return differentiate_along(problem, point, std::move(node), counts);
}

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point, int parameter,
                                            RunCounts& counts) {
  const auto& parameters = problem.model.description().parameters;
  if (parameters[static_cast<std::size_t>(parameter)].definition) {
    throw std::invalid_argument("differentiate_point: '" +
                                parameters.names()[static_cast<std::size_t>(parameter)] +
                                "' is defined by other parameters; differentiate along one of those");
  }
  if (parameter == problem.traced) return differentiate_point(problem, point, counts);
  return differentiate_point(problem, point, straight_series(problem, point, parameter), counts);
}

}  // namespace eigentrail
