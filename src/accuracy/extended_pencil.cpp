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

/// Newton corrections of (x, lambda). Multipliers are judged by the reaction A^T lambda, which is all that
/// the equations see of them. Returns the last correction, not a number when a residual is not finite.
double refine_equilibrium(const Model& model, const Equilibrium& equilibrium, ExtendedPath& path) {
  if (!equilibrium.kkt.can_solve()) return 0.0;  // the guess is the equilibrium, exactly
  const SystemMatrix& A = equilibrium.linearization.A[0];
  const double length = largest(equilibrium.x);
  // Where constraints carry no load, what the stiffness makes of the length is the scale of forces.
  const double force = std::max(largest(A.transposed_times(equilibrium.lambda)),
                                equilibrium.linearization.K[0].largest_entry() * length);
  return refine_to_rounding([&]() -> double {
    BasicSteadyResidual<Extended> residual;
    if (model.extended_residual(path, residual)) return NAN;
    Vector dx, dl;
    equilibrium.kkt.solve(-to_double(residual.force.col(0)), -to_double(residual.constraint.col(0)), dx, dl);
    path.x.col(0) += dx.cast<Extended>();
    path.lambda.col(0) += dl.cast<Extended>();
    return std::max(relative(largest(dx), length), relative(largest(A.transposed_times(dl)), force));
  });
}

/// T - A+ (A T) until A T vanishes: a null-space basis, orthonormal to double precision.
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
