#include "eigentrail/steady/path_plane.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/positive_or_one.hpp"
#include "core/singular_vectors.hpp"
#include "steady/bordered_kkt.hpp"
#include "steady/rounding.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

constexpr int most_corrections = 30;
/// In lengths: corrections that grow beyond this lead nowhere. Constraints of bodies that lie so far apart
/// depend on each other in rounding, and every further factorization of a large model would be a dense one.
constexpr double far_away = 1e3;

/// Derivative of the steady equations with respect to the traced parameter, at fixed x and lambda.
EvaluationFault parameter_slope(const Model& model, const Vector& x, const Vector& lambda,
                                const Vector& parameters, int traced, Vector& force, Vector& constraint,
                                EvaluationCounts& counts) {
  Path path{VectorSeries::Zero(parameters.size(), 2), x, lambda};
  path.parameters.col(0) = parameters;
  path.parameters(traced, 1) = 1.0;
  SteadyResidual residual;
  if (auto fault = model.residual(path, 1, residual, counts)) return fault;
  force = residual.force.col(1);
  constraint = residual.constraint.col(1);
  return {};
}

/// The steady equations with the traced parameter as an unknown on a plane, and trimmed parameters if there
/// are any.
class PlaneSystem {
 public:
  /// `force` and `constraint`: the derivatives of the equations with respect to the traced parameter.
  PlaneSystem(const Linearization& linearization, const ConstraintFactorization& constraints,
              const KktBorder& trim, const Vector& force, const Vector& constraint, const PathPlane& plane)
      : system_(
            factored(linearization, constraints, trim.and_one(force, constraint, plane.x, plane.u, plane.p))),
        n_trims_(trim.unknown.rows()) {}

  /// `g` and `dl` as in KktFactorization::solve.
  void solve(const Vector& r, const Vector& g, double distance, Vector& dx, Vector& dl, double& dp) const {
    const Eigen::Index m = g.size() - n_trims_;
    Vector h(n_trims_ + 1);
    h << g.tail(n_trims_), distance;
    Vector reactions, unknowns;
    std::visit([&](const auto& system) { system.solve(r, g.head(m), h, dx, reactions, unknowns); }, system_);
    dl.resize(g.size());
    dl << reactions, unknowns.head(n_trims_);
    dp = unknowns[n_trims_];
  }

 private:
  using System = std::variant<BorderedKkt, SparseKkt>;

  static System factored(const Linearization& at, const ConstraintFactorization& constraints,
                         const KktBorder& border) {
    const SystemMatrix &K = at.K[0], &A = at.A[0];
    if (K.is_sparse() && (constraints.is_sparse() || A.rows() == 0))
      return System(std::in_place_type<SparseKkt>, K.sparse(), A.sparse(), border);
    return System(std::in_place_type<BorderedKkt>, K, constraints, border);
  }

  System system_;
  Eigen::Index n_trims_;
};

/// The derivatives of the trimmed parameters at a point; without any they have no columns.
EvaluationFault trim_at(const Model& model, const Path& at, TrimDerivatives& trim, EvaluationCounts& counts) {
  trim = {Matrix(model.n_coordinates(), 0), Matrix(model.n_constraints(), 0),
          Matrix(0, model.n_coordinates()), Matrix(0, model.n_constraints()), Matrix(0, 0)};
  return model.n_trims() == 0 ? EvaluationFault() : model.trim_derivatives(at, trim, counts);
}

}  // namespace

Equilibrium solve_equilibrium_on(const PathPlane& plane, const Model& model, Vector parameters, int traced,
                                 const Vector& x, const Vector& lambda, const SteadyOptions& options,
                                 double& p, EvaluationCounts& counts) {
  Equilibrium result;
  result.x = x;
  result.lambda = lambda;
  result.report.message = "the correction across the path did not converge";
  const double length = positive_or_one(x.lpNorm<Eigen::Infinity>());
  double last = INFINITY;
  SteadyResidual residual;
  Vector force, constraint, dx, dl;
  TrimDerivatives trim;
  parameters[traced] = p;
  if (lambda.size() != model.n_multipliers()) {
    const Equilibrium rest = equilibrium_at_rest(model, parameters, x, counts);
    result.lambda = rest.lambda;
    if (rest.status != SteadyStatus::converged) {
      result.status = SteadyStatus::not_finite;
      return result;
    }
  }
  const double target = plane(x, result.lambda, p);
  for (int i = 0; i < options.max_iterations; ++i) {
    parameters[traced] = p;
    const Path path{parameters, result.x, result.lambda};
    if (model.residual(path, 0, residual, counts) || model.linearize(path, 0, result.linearization, counts) ||
        parameter_slope(model, result.x, result.lambda, parameters, traced, force, constraint, counts) ||
        trim_at(model, path, trim, counts)) {
      result.status = SteadyStatus::not_finite;
      return result;
    }
    result.kkt = KktFactorization(result.linearization.A[0]);
    ++result.report.factorizations;
    const PlaneSystem system(result.linearization, result.kkt.constraints(), KktBorder::of(trim), force,
                             constraint, plane);
    double dp = 0.0;
    system.solve(-residual.force.col(0), -residual.constraint.col(0),
                 target - plane(result.x, result.lambda, p), dx, dl, dp);
    result.x += dx;
    result.lambda += dl;
    p += dp;
    ++result.report.iterations;
    // Changes of the multipliers and of p are measured by the forces that they cause.
    const double scale = positive_or_one(result.linearization.K[0].largest_entry() * length);
    const Vector reaction = result.linearization.A[0].transposed_times(dl.head(model.n_constraints())) +
                            trim.force * dl.tail(model.n_trims()) + force * dp;
    const double size =
        std::max(dx.lpNorm<Eigen::Infinity>() / length, reaction.lpNorm<Eigen::Infinity>() / scale);
    // Small corrections that grow show divergence; large ones may grow far from the solution.
    const bool diverges = size > 2.0 * last && size < 1e-3;
    const bool is_lost = size > last && size > far_away;
    if (!std::isfinite(size) || diverges || is_lost || i > most_corrections) return result;
    if (size <= newton_rounding || (size > 0.5 * last && size < newton_rounding_floor)) {
      // Of a large scene only the constraints: near a fold or branch point the whole would be factored with
      // dense matrices. What needs it factors it itself.
      if (!result.linearization.K[0].is_sparse() || model.n_trims() > 0) {
        result.kkt = KktFactorization(result.linearization.K[0], result.linearization.A[0], trim);
        ++result.report.factorizations;
      }
      result.status = SteadyStatus::converged;
      result.report.message.clear();
      return result;
    }
    last = size;
  }
  return result;
}

EvaluationFault differentiate_equilibrium_on(const PathPlane& plane, const Model& model,
                                             const Equilibrium& equilibrium, const Vector& parameters,
                                             int traced, int order, Path& path, EvaluationCounts& counts) {
  path.parameters = VectorSeries::Zero(parameters.size(), order + 1);
  path.parameters.col(0) = parameters;
  path.x = VectorSeries::Zero(model.n_coordinates(), order + 1);
  path.lambda = VectorSeries::Zero(model.n_multipliers(), order + 1);
  path.x.col(0) = equilibrium.x;
  path.lambda.col(0) = equilibrium.lambda;
  Vector force, constraint, dx, dl;
  TrimDerivatives trim;
  if (auto fault = trim_at(model, {parameters, equilibrium.x, equilibrium.lambda}, trim, counts))
    return fault;
  if (auto fault = parameter_slope(model, equilibrium.x, equilibrium.lambda, parameters, traced, force,
                                   constraint, counts))
    return fault;
  const PlaneSystem system(equilibrium.linearization, equilibrium.kkt.constraints(), KktBorder::of(trim),
                           force, constraint, plane);
  SteadyResidual residual;
  for (int k = 1; k <= order; ++k) {
    if (auto fault = model.residual(path, k, residual, counts)) return fault;
    double dp = 0.0;
    system.solve(-residual.force.col(k), -residual.constraint.col(k), k == 1 ? 1.0 : 0.0, dx, dl, dp);
    path.x.col(k) = dx;
    path.lambda.col(k) = dl;
    path.parameters(traced, k) = dp;
  }
  return {};
}

namespace {

/// For a unit change of the parameter: the minimum-norm motion `follow` that keeps the constraints, and the
/// force `load` that then acts.
EvaluationFault parameter_load(const Model& model, const Path& point, int traced,
                               const Linearization& linearization, Vector& follow, Vector& load,
                               EvaluationCounts& counts) {
  Vector force, constraint;
  if (auto fault = parameter_slope(model, point.x.col(0), point.lambda.col(0), point.parameters.col(0),
                                   traced, force, constraint, counts))
    return fault;
  follow = -ConstraintFactorization(linearization.A[0])
                .pseudo_inverse_times(constraint.head(model.n_constraints()));
  load = force + linearization.K[0] * follow;
  return {};
}

/// Whether a basis spans only a part of the motions that the constraints allow, as in a projected scene.
bool spans_a_part(const Matrix& tangent_basis, const Linearization& linearization) {
  const SystemMatrix &K = linearization.K[0], &A = linearization.A[0];
  return tangent_basis.cols() < K.rows() - A.rows() && K.is_sparse() && A.is_sparse();
}

/// The left kernel of the singular stiffness T^T K T, n; of the whole stiffness where T spans a part of the
/// motions.
Vector left_kernel(const Linearization& linearization, const Matrix& tangent_basis) {
  if (spans_a_part(tangent_basis, linearization)) {
    const auto kernel = kkt_kernel(linearization.K[0].sparse(), linearization.A[0].sparse());
    if (kernel) return kernel->left;
  }
  const SingularVectors<Matrix> svd =
      singular_vectors(Matrix(tangent_basis.transpose() * linearization.K[0] * tangent_basis));
  return tangent_basis * svd.U.col(tangent_basis.cols() - 1);
}

}  // namespace

std::vector<KernelLoad> kernel_loads(const Model& model, const Path& point,
                                     const std::vector<int>& parameters, const Linearization& linearization,
                                     const Matrix& tangent_basis, EvaluationCounts& counts) {
  const Vector kernel = left_kernel(linearization, tangent_basis);
  std::vector<KernelLoad> loads;
  for (const int parameter : parameters) {
    Vector follow, load;
    const bool known =
        !parameter_load(model, point, parameter, linearization, follow, load, counts) && load.allFinite();
    loads.push_back(known ? KernelLoad{kernel.dot(load), load.norm()} : KernelLoad{NAN, NAN});
  }
  return loads;
}

double kernel_share_of_parameter(const Model& model, const Path& point, int traced,
                                 const Linearization& linearization, const Matrix& tangent_basis,
                                 EvaluationCounts& counts) {
  const KernelLoad load = kernel_loads(model, point, {traced}, linearization, tangent_basis, counts).front();
  if (std::isnan(load.total)) return 1.0;
  return load.total > 0.0 ? std::abs(load.along_kernel) / load.total : 0.0;
}

namespace {

/// As directions_at_branch_point, of a large scene whose tangent basis spans few of its motions: they tell
/// nothing of how the whole follows the parameter. The kernel of the whole borders its equations.
Matrix directions_of_the_whole(const Model& model, const Path& point, int traced,
                               const Linearization& linearization, EvaluationCounts& counts) {
  const SparseMatrix &K = linearization.K[0].sparse(), &A = linearization.A[0].sparse();
  Vector force, constraint;
  if (parameter_slope(model, point.x.col(0), point.lambda.col(0), point.parameters.col(0), traced, force,
                      constraint, counts))
    return {};
  const std::optional<KktKernel> kernel = kkt_kernel(K, A);
  if (!kernel) return {};
  const Eigen::Index n = K.rows();
  Vector followed, multipliers, rest;
  SparseKkt(K, A, kernel->border(A.rows()))
      .solve(-force, -constraint, Vector::Zero(1), followed, multipliers, rest);
  Matrix directions(n + 1, 2);
  directions.col(0) << kernel->right, 0.0;
  directions.col(1) << followed, 1.0;
  return directions;
}

}  // namespace

Matrix directions_at_branch_point(const Model& model, const Path& point, int traced,
                                  const Linearization& linearization, const Matrix& tangent_basis,
                                  EvaluationCounts& counts) {
  if (spans_a_part(tangent_basis, linearization))
    return directions_of_the_whole(model, point, traced, linearization, counts);
  Vector follow, load;
  if (parameter_load(model, point, traced, linearization, follow, load, counts)) return {};
  const SingularVectors<Matrix> svd =
      singular_vectors(Matrix(tangent_basis.transpose() * linearization.K[0] * tangent_basis));
  const Eigen::Index regular = tangent_basis.cols() - 1;
  const Vector loads = svd.U.leftCols(regular).transpose() * (tangent_basis.transpose() * load);
  const Vector y = svd.V.leftCols(regular) * loads.cwiseQuotient(svd.values.head(regular));
  Matrix directions(tangent_basis.rows() + 1, 2);
  directions.col(0) << tangent_basis * svd.V.col(regular), 0.0;
  directions.col(1) << follow - tangent_basis * y, 1.0;
  return directions;
}

}  // namespace eigentrail
