#include "eigentrail/continuation/path_point.hpp"

#include <cmath>
#include <functional>
#include <stdexcept>

namespace eigentrail {
namespace {

void size_counters(const PathProblem& problem, RunCounts& counts) {
  if (counts.evaluations.residual.empty()) counts.evaluations = problem.model.new_counts();
}

Equilibrium equilibrium_at(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                           RunCounts& counts) {
  const StageTimer timer(counts.equilibrium_seconds);
  const Vector parameters = parameters_at(problem, p);
  // A fixed equilibrium is solved once, at the start, and kept.
  if (problem.structure.known_equilibrium || (problem.structure.fixed_equilibrium && guess.solved)) {
    const Eigen::Index m = problem.model.n_constraints();
    const Vector lambda = guess.lambda.size() == m ? guess.lambda : Vector(Vector::Zero(m));
    return keep_equilibrium(problem.model, parameters, guess.x, lambda, counts.evaluations);
  }
  Equilibrium result =
      solve_equilibrium(problem.model, parameters, guess.x, guess.lambda, problem.steady, counts.evaluations);
  counts.equilibrium_iterations += static_cast<std::uint64_t>(result.report.iterations);
  counts.equilibrium_factorizations += static_cast<std::uint64_t>(result.report.factorizations);
  return result;
}

/// Series of the equilibrium when `parameter` moves away from its value at the point.
EvaluationFault path_series(const PathProblem& problem, const PathPoint& point, int parameter, Path& path,
                            RunCounts& counts) {
  VectorSeries parameters = VectorSeries::Zero(problem.parameters.size(), 2);
  parameters.col(0) = parameters_at(problem, point.p);
  parameters(parameter, 1) = 1.0;
  if (problem.model.structure(parameter).fixed_equilibrium) {
    path = {parameters, point.equilibrium.x, point.equilibrium.lambda};
    return {};
  }
  return differentiate_equilibrium(problem.model, point.equilibrium, parameters, problem.order, path,
                                   counts.evaluations);
}

/// Series of v = T z.
ComplexVectorSeries physical_series(const TangentBasis& basis, const ComplexVectorSeries& z) {
  if (basis.is_identity) return z;
  ComplexVectorSeries v = ComplexVectorSeries::Zero(basis.T[0].rows(), z.cols());
  for (std::size_t j = 0; j < basis.T.size(); ++j) {
    const auto shift = static_cast<Eigen::Index>(j);
    if (shift >= z.cols()) break;
    v.rightCols(z.cols() - shift) += basis.T[j].cast<Complex>() * z.leftCols(z.cols() - shift);
  }
  return v;
}

}  // namespace

ComplexVector PathPoint::eigenvalues() const {
  ComplexVector s(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) s[static_cast<Eigen::Index>(i)] = modes[i].s;
  return s;
}

ComplexMatrix PathPoint::shapes() const {
  ComplexMatrix z(pencil.size(), static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) z.col(static_cast<Eigen::Index>(i)) = modes[i].z;
  return basis.is_identity ? z : ComplexMatrix(basis.T[0].cast<Complex>() * z);
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
                    const Matrix& previous_basis, RunCounts& counts) {
  size_counters(problem, counts);
  PathPoint point;
  point.p = p;
  point.equilibrium = equilibrium_at(problem, p, guess, counts);
  if (point.equilibrium.status != SteadyStatus::converged) {
    point.status = PointStatus::no_equilibrium;
    point.message = point.equilibrium.report.message;
    return point;
  }
  const StageTimer timer(counts.reduction_seconds);
  point.basis = tangent_basis(point.equilibrium.kkt.constraints(), previous_basis);
  if (problem.basis == BasisChoice::random) randomize_basis(point.basis, std::hash<double>()(p));
  point.pencil = reduce(point.equilibrium.linearization, point.basis, 0);
  return point;
}

PathPoint compute_point(const PathProblem& problem, double p, const Prediction& prediction,
                        const Matrix& previous_basis, RunCounts& counts) {
  PathPoint point = reduce_at(problem, p, prediction.equilibrium, previous_basis, counts);
  if (point.status != PointStatus::computed) return point;
  if (point.pencil.size() != previous_basis.cols()) {
    point.status = PointStatus::no_equilibrium;
    point.message = "the number of independent constraints changed";
    return point;
  }
  const StageTimer timer(counts.modes_seconds);
  const PencilAtPoint pencil(point.pencil);
  for (Eigen::Index i = 0; i < prediction.s.size(); ++i) {
    const ComplexVector shape = prediction.shapes.col(i);
    const ComplexVector z =
        point.basis.is_identity ? shape : ComplexVector(point.basis.T[0].transpose().cast<Complex>() * shape);
    point.modes.push_back(
        correct_mode(pencil, prediction.s[i], z, problem.s_ref, problem.corrector, counts.modes));
    if (point.modes.back().status != ModeStatus::converged) {
      point.status = PointStatus::mode_lost;
      point.lost_mode = static_cast<int>(i);
      point.message = "mode " + std::to_string(i + 1) + ": the corrector did not converge";
      return point;
    }
  }
  return point;
}

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point,
                                            RunCounts& counts) {
  return differentiate_point(problem, point, problem.traced, counts);
}

std::optional<PathNode> differentiate_point(const PathProblem& problem, const PathPoint& point, int parameter,
                                            RunCounts& counts) {
  const auto& parameters = problem.model.description().parameters;
  if (parameters[static_cast<std::size_t>(parameter)].definition) {
    throw std::invalid_argument("differentiate_point: '" +
                                parameters.names()[static_cast<std::size_t>(parameter)] +
                                "' is defined by other parameters; differentiate along one of those");
  }
  size_counters(problem, counts);
  const StageTimer timer(counts.differentiation_seconds);
  PathNode node;
  node.p = point.p;
  if (path_series(problem, point, parameter, node.path, counts)) return std::nullopt;
  Linearization linearization;
  if (problem.model.linearize(node.path, problem.order, linearization, counts.evaluations))
    return std::nullopt;
  TangentBasis basis = point.basis;
  differentiate_basis(point.equilibrium.kkt.constraints(), linearization.A, problem.order, basis);
  const ReducedPencil pencil = reduce(linearization, basis, problem.order);

  const auto n_modes = static_cast<Eigen::Index>(point.modes.size());
  node.s.resize(n_modes, problem.order + 1);
  node.backward_error.resize(n_modes);
  node.condition.resize(n_modes);
  for (Eigen::Index i = 0; i < n_modes; ++i) {
    const Mode& mode = point.modes[static_cast<std::size_t>(i)];
    const ModeSeries series = differentiate_mode(pencil, mode, problem.order, counts.modes);
    node.s.row(i) = series.s.transpose();
    node.shapes.push_back(physical_series(basis, series.z));
    node.backward_error[i] = mode.backward_error;
    node.condition[i] = mode.condition;
  }
  if (!node.s.allFinite()) return std::nullopt;
  node.mass = linearization.M[0];
  node.basis = basis.T[0];
  return node;
}

}  // namespace eigentrail
