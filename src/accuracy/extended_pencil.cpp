#include "accuracy/extended_pencil.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

using ExtendedPath = BasicPath<Extended>;

double largest(const Vector& values) {
  return values.size() == 0 ? 0.0 : values.lpNorm<Eigen::Infinity>();
}

double relative(double change, double whole) {
  return whole > 0.0 ? change / whole : change;
}

/// Newton corrections of (x, lambda). The correction of the multipliers is measured by that of the reaction
/// A^T lambda, because lambda itself is not unique if constraints are redundant. Returns the last relative
/// correction; NaN if a residual cannot be evaluated.
double refine_equilibrium(const Model& model, const Equilibrium& equilibrium, ExtendedPath& path) {
  if (!equilibrium.kkt.can_solve()) return 0.0;  // the equilibrium is known exactly
  const SystemMatrix& A = equilibrium.linearization.A[0];
  const double length = largest(equilibrium.x);
  // The scale of forces is the reaction, or stiffness times length if the constraints carry no load.
  const Eigen::Index m = model.n_constraints();
  const double force = std::max(largest(A.transposed_times(equilibrium.lambda.head(m))),
                                equilibrium.linearization.K[0].largest_entry() * length);
  return refine_to_rounding([&]() -> double {
    BasicSteadyResidual<Extended> residual;
    if (model.extended_residual(path, residual)) return NAN;
    Vector dx, dl;
    equilibrium.kkt.solve(-to_double(residual.force.col(0)), -to_double(residual.constraint.col(0)), dx, dl);
    path.x.col(0) += dx.cast<Extended>();
    path.lambda.col(0) += dl.cast<Extended>();
    return std::max(relative(largest(dx), length), relative(largest(A.transposed_times(dl.head(m))), force));
  });
}

/// Repeats T <- T - A+ (A T), with the pseudo-inverse A+, until A T vanishes within rounding of 113 bits. T
/// is then a null-space basis that is orthonormal to double precision. Returns the last correction.
double refine_basis(const ConstraintFactorization& constraints, const BasicSystemMatrix<Extended>& A,
                    ExtendedMatrix& T) {
  if (constraints.rank() == 0 || T.size() == 0) return 0.0;
  return refine_to_rounding([&] {
    const Matrix change = constraints.pseudo_inverse_times(to_double(A * T));
    T -= change.cast<Extended>();
    return change.cwiseAbs().maxCoeff();
  });
}

}  // namespace

std::optional<ExtendedPencil> extended_pencil(const PathProblem& problem, const PathPoint& point) {
  ExtendedPath path{parameters_at(problem, point.p).cast<Extended>(), point.equilibrium.x.cast<Extended>(),
                    point.equilibrium.lambda.cast<Extended>()};
  ExtendedPencil pencil;
  const double moved = refine_equilibrium(problem.model, point.equilibrium, path);
  BasicLinearization<Extended> full;
  if (!std::isfinite(moved) || problem.model.extended_linearization(path, full)) return std::nullopt;
  ExtendedMatrix T = point.basis.T[0].cast<Extended>();
  const double turned = refine_basis(point.equilibrium.kkt.constraints(), full.A[0], T);
  const auto projected = [&T](const BasicSystemMatrix<Extended>& B) {
    return ExtendedMatrix((T.transpose() * B) * T);
  };
  pencil.M = projected(full.M[0]);
  pencil.C = projected(full.C[0]);
  pencil.K = projected(full.K[0]);
  pencil.correction = std::max(moved, turned);
  return pencil;
}

}  // namespace eigentrail
