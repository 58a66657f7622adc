#include "eigentrail/continuation/path_point.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/matrix_series.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"
#include "eigentrail/modes/symmetric_pairs.hpp"

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

/// Corrects the predicted pairs all at once, if the problem allows that and it works at this point.
bool correct_together(const PathProblem& problem, const std::vector<InvariantPair>& starts, PathPoint& point,
                      RunCounts& counts) {
  if (problem.route == ModeRoute::one_by_one || !is_complete(starts, point.pencil.size())) return false;
  const PencilAtPoint pencil(point.pencil, Chart::finite);
  const double reference = problem.reference(Chart::finite);
  if (problem.route == ModeRoute::symmetric) {
    point.symmetric =
        correct_symmetric(pencil, starts, reference, problem.corrector, counts.modes, point.pairs);
  }
  if (point.symmetric) return true;
  point.all = correct_all(pencil, starts, reference, problem.corrector, counts.modes, point.pairs);
  return point.all != nullptr;
}

/// Corrects the predicted pairs (Z in physical coordinates) at a reduced point, all at once or one by one.
void correct_modes(const PathProblem& problem, const std::vector<InvariantPair>& predicted, PathPoint& point,
                   RunCounts& counts) {
  const StageTimer timer(counts.modes_seconds);
  std::vector<InvariantPair> starts = predicted;
  if (!point.basis.is_identity) {
    const Matrix projection = point.basis.T[0].transpose();
    for (InvariantPair& start : starts) start.Z = multiply(projection, start.Z);
  }
  if (correct_together(problem, starts, point, counts)) return;
  const PencilAtPoint finite(point.pencil, Chart::finite);
  const PencilAtPoint reciprocal(point.pencil, Chart::reciprocal);
  point.pairs.resize(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const PencilAtPoint& pencil = starts[i].chart == Chart::finite ? finite : reciprocal;
    point.pairs[i] =
        correct_pair(pencil, starts[i], problem.reference(starts[i].chart), problem.corrector, counts.modes);
    if (point.pairs[i].status != PairStatus::converged) {
      point.status = PointStatus::mode_lost;
      point.lost_track = static_cast<int>(i);
      point.message = "the corrector did not converge";
      return;
    }
  }
}

/// A track of a corrected pair and its series in reduced coordinates.
Track make_track(const PathNode& node, InvariantPair pair, PairSeries series) {
  Track track;
  track.pair = std::move(pair);
  track.functions = block_functions(series.Lambda);
  track.roots = pair_eigenvalues(track.pair);
  track.modes.assign(static_cast<std::size_t>(track.size()), Track::no_mode);
  track.series = {physical_series(node.basis, std::move(series.Z)), std::move(series.Lambda)};
  return track;
}

bool is_finite(const Track& track) {
  return track.functions.allFinite() && std::all_of(track.series.Z.begin(), track.series.Z.end(),
                                                    [](const auto& Z) { return Z.allFinite(); });
}

}  // namespace

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
  correct_modes(problem, prediction.pairs, point, counts);
  return point;
}

Track differentiate_track(const PathProblem& problem, const PathNode& node, InvariantPair pair,
                          RunCounts& counts) {
  PairSeries series = differentiate_pair(node.pencil, pair, problem.order + 1, counts.modes,
                                         problem.corrector.series_accuracy);
  return make_track(node, std::move(pair), std::move(series));
}

namespace {

/// Series of all pairs of a point, the way they were corrected.
std::vector<Track> tracks_of(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                             RunCounts& counts) {
  const int order = problem.order + 1;
  std::vector<Track> tracks;
  std::vector<PairSeries> series;
  if (point.symmetric) {
    series = differentiate_symmetric(node.pencil, *point.symmetric, order, counts.modes);
  } else if (point.all) {
    series =
        differentiate_all(node.pencil, *point.all, order, problem.corrector.series_accuracy, counts.modes);
  }
  for (std::size_t i = 0; i < point.pairs.size(); ++i) {
    tracks.push_back(series.empty() ? differentiate_track(problem, node, point.pairs[i], counts)
                                    : make_track(node, point.pairs[i], std::move(series[i])));
  }
  return tracks;
}

/// What follows from the path of a node that has one.
std::optional<PathNode> differentiate_along(const PathProblem& problem, const PathPoint& point, PathNode node,
                                            RunCounts& counts) {
  const int order = problem.order + 1;
  node.p = point.p;
  if (problem.model.linearize(node.path, order, node.linearization, counts.evaluations)) return std::nullopt;
  node.basis = point.basis;
  differentiate_basis(point.equilibrium.kkt.constraints(), node.linearization.A, order, node.basis);
  node.pencil = reduce(node.linearization, node.basis, order);
  node.tracks = tracks_of(problem, point, node, counts);
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
