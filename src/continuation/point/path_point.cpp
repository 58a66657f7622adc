#include "eigentrail/continuation/path_point.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "eigentrail/continuation/point_modes.hpp"
#include "reduction/part_copies.hpp"
#include "steady/redundancy.hpp"

namespace eigentrail {
namespace {

/// Gives the evaluation counters their size at the first use.
void size_counters(const PathProblem& problem, RunCounts& counts) {
  if (counts.evaluations.residual.empty()) counts.evaluations = problem.model.new_counts();
}

/// The equilibrium at p, or on a plane, where p is an unknown and is overwritten.
Equilibrium equilibrium_at(const PathProblem& problem, double& p, const EquilibriumGuess& guess,
                           const std::optional<PathPlane>& plane, RunCounts& counts) {
  const StageTimer timer(counts.equilibrium_seconds);
  const Vector parameters = parameters_at(problem, p);
  // An equilibrium that does not depend on the parameter is solved for once, at the start.
  if (problem.structure.known_equilibrium || (problem.structure.fixed_equilibrium && guess.solved)) {
    const bool known = guess.lambda.size() == problem.model.n_multipliers();
    const Vector lambda = known ? guess.lambda : problem.model.first_multipliers(parameters);
    return keep_equilibrium(problem.model, parameters, guess.x, lambda, counts.evaluations);
  }
  if (problem.rests && guess.solved && !plane)
    return equilibrium_at_rest(problem.model, parameters, guess.x, counts.evaluations);
  // Relaxation to a state of rest is allowed only at the start. On the path a failure indicates a fold or a
  // branch point, and relaxation might lead to an equilibrium on another path.
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

/// Series of all parameters if one of them is its value at the point plus h.
VectorSeries straight_series(const PathProblem& problem, const PathPoint& point, int parameter) {
  VectorSeries parameters = VectorSeries::Zero(problem.parameters.size(), 2);
  parameters.col(0) = parameters_at(problem, point.p);
  parameters(parameter, 1) = 1.0;
  return parameters;
}

/// Whether the equilibrium does not change along a series of parameters.
bool keeps_equilibrium(const Model& model, const VectorSeries& parameters) {
  for (Eigen::Index i = 0; i < parameters.rows(); ++i) {
    const bool moves = !parameters.row(i).tail(parameters.cols() - 1).isZero(0.0);
    if (moves && !model.structure(static_cast<int>(i)).fixed_equilibrium) return false;
  }
  return true;
}

/// Series of the equilibrium along a series of all parameters.
EvaluationFault series_along(const PathProblem& problem, const PathPoint& point,
                             const VectorSeries& parameters, int order, Path& path, RunCounts& counts) {
  if (keeps_equilibrium(problem.model, parameters)) {
    path = {parameters, point.equilibrium.x, point.equilibrium.lambda};
    return {};
  }
  return differentiate_equilibrium(problem.model, point.equilibrium, parameters, order, path,
                                   counts.evaluations);
}

/// The same along the traced parameter.
EvaluationFault series_along_path(const PathProblem& problem, const PathPoint& point, int order, Path& path,
                                  RunCounts& counts) {
  const VectorSeries parameters = straight_series(problem, point, problem.traced);
  if (!problem.rests || problem.structure.fixed_equilibrium)
    return series_along(problem, point, parameters, order, path, counts);
  return differentiate_multipliers(problem.model, point.equilibrium, parameters, order, path,
                                   counts.evaluations);
}

/// Whether the equations at a point have the parts of the problem. Those of a family, and of a scene at rest,
/// have them everywhere. Where the equilibrium moves they are found from a few places, and another
/// equilibrium may have less symmetry.
bool falls_apart_here(const PathProblem& problem, const IndependentParts& parts, const PathPoint& point) {
  const Structure& structure = problem.structure;
  if (problem.rests || structure.fixed_equilibrium || structure.known_equilibrium) return true;
  if (!parts.falls_apart()) return true;
  // The rounding of the equilibrium, a few units in the last place of the forces, times its condition. It has
  // to be far below the tolerance of a trace: a larger departure is followed as if it were zero.
  constexpr double rounding = 1e-11;
  const Linearization& here = point.equilibrium.linearization;
  const auto departure = [&](const SystemSeries& B) { return departure_from_parts(B[0].dense(), parts); };
  return std::max({departure(here.M), departure(here.C), departure(here.K)}) <= rounding;
}

void set_no_equilibrium(PathPoint& point, std::string message) {
  point.status = PointStatus::no_equilibrium;
  point.message = std::move(message);
}

/// Tangent basis and reduced pencil at the point's equilibrium. Sets the status if there is no equilibrium.
void reduce_point(const PathProblem& problem, const Matrix& previous_basis, PathPoint& point,
                  RunCounts& counts) {
  const Equilibrium& at = point.equilibrium;
  if (at.status != SteadyStatus::converged) return set_no_equilibrium(point, at.report.message);
  const StageTimer timer(counts.reduction_seconds);
  std::string fault =
      undetermined_stiffness(problem.model, parameters_at(problem, point.p), at, counts.evaluations);
  if (!fault.empty()) return set_no_equilibrium(point, std::move(fault));
  const ConstraintFactorization& constraints = at.kkt.constraints();
  const Projection* projection = problem.model.projection();
  if (problem.parts) {
    auto parts = turned(problem.parts, constraints);
    if (!parts || !falls_apart_here(problem, *parts, point))
      return set_no_equilibrium(
          point, "the equations do not fall apart here as they do at other places of the range");
    point.basis = basis_of(std::move(parts));
  } else if (projection != nullptr && projection->motions) {
    auto basis = restricted_basis(*projection->motions, at.linearization.A[0], constraints);
    if (!basis)
      return set_no_equilibrium(
          point,
          "bodies have turned by about 90 degrees since the reference of the projected model; trace "
          "the range in two parts");
    point.basis = std::move(*basis);
  } else {
    point.basis = tangent_basis(constraints, previous_basis);
  }
  if (problem.basis == BasisChoice::random) randomize_basis(point.basis, std::hash<double>()(point.p));
  point.pencil = reduce(at.linearization, point.basis, 0);
}

bool is_finite(const Track& track) {
  return track.functions.allFinite() && std::all_of(track.series.Z.begin(), track.series.Z.end(),
                                                    [](const auto& Z) { return Z.allFinite(); });
}

}  // namespace

ComplexMatrix PathPoint::shapes(std::size_t pair) const {
  return basis.shapes(pairs[pair].Z, pairs[pair].part);
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
  if (!point.plane) return series_along_path(problem, point, order, path, counts);
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
    set_no_equilibrium(point, "the number of independent constraints changed");
    return point;
  }
  correct_modes(problem, prediction, point, counts);
  return point;
}

namespace {

/// The node of a point with all its series, from that of its equilibrium: `differentiate(order, path)` sets
/// the path, and returns a fault if that fails. Empty if a series is not finite.
template <class Differentiate>
std::optional<PathNode> differentiated(const PathProblem& problem, const PathPoint& point, RunCounts& counts,
                                       const Differentiate& differentiate) {
  size_counters(problem, counts);
  const StageTimer timer(counts.differentiation_seconds);
  const int order = problem.order + 1;
  PathNode node;
  if (differentiate(order, node.path)) return std::nullopt;
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
  return differentiated(problem, point, counts, [&](int order, Path& path) {
    return equilibrium_series(problem, point, order, path, counts);
  });
}

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            const VectorSeries& parameters, RunCounts& counts) {
  return differentiated(problem, point, counts, [&](int order, Path& path) {
    return series_along(problem, point, parameters, order, path, counts);
  });
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
