#include "eigentrail/steady/path_plane.hpp"
#include "core/singular_vectors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/positive_or_one.hpp"
#include "steady/rounding.hpp"

namespace eigentrail {
namespace {

constexpr int most_corrections = 30;

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

/// Solves with the matrix [K A^T f; A 0 g; c.x 0 c.p] by the null-space method, as in KktFactorization. f and
/// g are the derivatives of the equations with respect to the parameter.
class BorderedKkt {
 public:
  BorderedKkt(const Linearization& linearization, const ConstraintFactorization& constraints,
              const Vector& force, const Vector& constraint, const PathPlane& plane)
      : K_(linearization.K[0]), constraints_(constraints), force_(force), plane_(plane) {
    const Matrix& Q2 = constraints.null_basis();
    const Eigen::Index f = Q2.cols();
    follow_ = -constraints.pseudo_inverse_times(constraint);
    Matrix B(f + 1, f + 1);
    B.topLeftCorner(f, f) = Q2.transpose() * K_ * Q2;
    B.topRightCorner(f, 1) = Q2.transpose() * (force + K_ * follow_);
    B.bottomLeftCorner(1, f) = plane.x.transpose() * Q2;
    B(f, f) = plane.p + plane.x.dot(follow_);
    // Rows and columns of different units are scaled to unit norm.
    const auto inverse = [](double size) { return size > 0.0 ? 1.0 / size : 1.0; };
    rows_ = B.rowwise().norm().unaryExpr(inverse);
    B = rows_.asDiagonal() * B;
    columns_ = B.colwise().norm().transpose().unaryExpr(inverse);
    lu_.compute(B * columns_.asDiagonal());
  }

  void solve(const Vector& r, const Vector& g, double distance, Vector& dx, Vector& dl, double& dp) const {
    const Matrix& Q2 = constraints_.null_basis();
    dx = constraints_.pseudo_inverse_times(g);
    Vector right(Q2.cols() + 1);
    right << Q2.transpose() * (r - K_ * dx), distance - plane_.x.dot(dx);
    const Vector solution = columns_.cwiseProduct(lu_.solve(rows_.cwiseProduct(right)));
    dp = solution[Q2.cols()];
    dx += Q2 * solution.head(Q2.cols()) + dp * follow_;
    dl = constraints_.transposed_pseudo_inverse_times(r - K_ * dx - dp * force_);
  }

 private:
  Matrix K_;  ///< dense; only a few points of a path are computed on a plane
  const ConstraintFactorization& constraints_;
  Vector force_, follow_, rows_, columns_;
  PathPlane plane_;
  Eigen::FullPivLU<Matrix> lu_;
};

/// Least-squares multipliers (Eq. 15) at given x.
EvaluationFault estimate_multipliers(const Model& model, const Vector& parameters, Equilibrium& at,
                                     EvaluationCounts& counts) {
  at.lambda = Vector::Zero(model.n_constraints());
  const Path path{parameters, at.x, at.lambda};
  SteadyResidual residual;
  if (auto fault = model.residual(path, 0, residual, counts)) return fault;
  if (auto fault = model.linearize(path, 0, at.linearization, counts)) return fault;
  at.lambda =
      ConstraintFactorization(at.linearization.A[0]).transposed_pseudo_inverse_times(-residual.force.col(0));
  return {};
}

}  // namespace

Equilibrium solve_equilibrium_on(const PathPlane& plane, const Model& model, Vector parameters, int traced,
                                 const Vector& x, const Vector& lambda, const SteadyOptions& options,
                                 double& p, EvaluationCounts& counts) {
  Equilibrium result;
  result.x = x;
  result.lambda = lambda;
  result.report.message = "the correction across the path did not converge";
  const double target = plane(x, p);
  const double length = positive_or_one(x.lpNorm<Eigen::Infinity>());
  double last = INFINITY;
  SteadyResidual residual;
  Vector force, constraint, dx, dl;
  parameters[traced] = p;
  if (lambda.size() != model.n_constraints() && estimate_multipliers(model, parameters, result, counts)) {
    result.status = SteadyStatus::not_finite;
    return result;
  }
  for (int i = 0; i < options.max_iterations; ++i) {
    parameters[traced] = p;
    const Path path{parameters, result.x, result.lambda};
    if (model.residual(path, 0, residual, counts) || model.linearize(path, 0, result.linearization, counts) ||
        parameter_slope(model, result.x, result.lambda, parameters, traced, force, constraint, counts)) {
      result.status = SteadyStatus::not_finite;
      return result;
    }
    result.kkt = KktFactorization(result.linearization.K[0], result.linearization.A[0]);
    ++result.report.factorizations;
    const BorderedKkt system(result.linearization, result.kkt.constraints(), force, constraint, plane);
    double dp = 0.0;
    system.solve(-residual.force.col(0), -residual.constraint.col(0), target - plane(result.x, p), dx, dl,
                 dp);
    result.x += dx;
    result.lambda += dl;
    p += dp;
    ++result.report.iterations;
    // Changes of the multipliers and of p are measured by the forces that they cause.
    const double scale = positive_or_one(result.linearization.K[0].largest_entry() * length);
    const Vector reaction = result.linearization.A[0].transposed_times(dl) + force * dp;
    const double size =
        std::max(dx.lpNorm<Eigen::Infinity>() / length, reaction.lpNorm<Eigen::Infinity>() / scale);
    // Small corrections that grow show divergence; large ones may grow far from the solution.
    if (!std::isfinite(size) || (size > 2.0 * last && size < 1e-3) || i > most_corrections) return result;
    if (size <= newton_rounding || (size > 0.5 * last && size < newton_rounding_floor)) {
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
  path.lambda = VectorSeries::Zero(model.n_constraints(), order + 1);
  path.x.col(0) = equilibrium.x;
  path.lambda.col(0) = equilibrium.lambda;
  Vector force, constraint, dx, dl;
  if (auto fault = parameter_slope(model, equilibrium.x, equilibrium.lambda, parameters, traced, force,
                                   constraint, counts))
    return fault;
  const BorderedKkt system(equilibrium.linearization, equilibrium.kkt.constraints(), force, constraint,
                           plane);
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
  follow = -ConstraintFactorization(linearization.A[0]).pseudo_inverse_times(constraint);
  load = force + linearization.K[0] * follow;
  return {};
}

}  // namespace

std::vector<KernelLoad> kernel_loads(const Model& model, const Path& point,
                                     const std::vector<int>& parameters, const Linearization& linearization,
                                     const Matrix& tangent_basis, EvaluationCounts& counts) {
  const SingularVectors<Matrix> svd =
      singular_vectors(Matrix(tangent_basis.transpose() * linearization.K[0] * tangent_basis));
  const Vector kernel = tangent_basis * svd.U.col(tangent_basis.cols() - 1);
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

Matrix directions_at_branch_point(const Model& model, const Path& point, int traced,
                                  const Linearization& linearization, const Matrix& tangent_basis,
                                  EvaluationCounts& counts) {
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
