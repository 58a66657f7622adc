// Equilibria with the traced parameter as an additional unknown: pseudo-arclength continuation (Keller 1977).
//
// Near a fold, p cannot serve as the coordinate of the path. The point is then determined on a plane
//
//     c.x (x - x*) + c.u (u - u*) + c.p (p - p*) = distance
//
// with the trimmed parameters u, if there are any, that intersects the path. The distance is the coordinate
// sigma along the path: x, lambda and p are power series in it. The steady equations gain one row and one
// column; the bordered system stays nonsingular at a fold.
#pragma once

#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

/// Linear function that measures progress along the path.
struct PathPlane {
  Vector x;        ///< size n
  double p = 1.0;  ///< coefficient of the traced parameter
  Vector u = {};   ///< of the trimmed parameters, size k; empty: zero

  /// `lambda` as in Path::lambda, with the trimmed parameters in the last rows.
  double operator()(const Vector& position, const Vector& lambda, double parameter) const {
    const double along = x.dot(position) + p * parameter;
    return u.size() > 0 ? along + u.dot(lambda.tail(u.size())) : along;
  }
};

/// Equilibrium at the intersection of the path with the plane through the guess (x, p), by Newton's method.
/// An empty `lambda` is replaced by the least-squares multipliers at the guess. `parameters` (declared units)
/// are all parameters, the traced one with its guess. On return `p` is the parameter at the solution.
Equilibrium solve_equilibrium_on(const PathPlane& plane, const Model& model, Vector parameters, int traced,
                                 const Vector& x, const Vector& lambda, const SteadyOptions& options,
                                 double& p, EvaluationCounts& counts);

/// Power series of (x, lambda, p) in the coordinate of the plane about an equilibrium, up to `order`.
EvaluationFault differentiate_equilibrium_on(const PathPlane& plane, const Model& model,
                                             const Equilibrium& equilibrium, const Vector& parameters,
                                             int traced, int order, Path& path, EvaluationCounts& counts);

/// The force that results from a unit change of a parameter, measured in the parameter's unit.
struct KernelLoad {
  double along_kernel = 0.0;  ///< component along the left null vector of the tangent stiffness T^T K T
  double total = 0.0;         ///< Euclidean norm
};

/// The load of each of `parameters` (indices) at a point with singular tangent stiffness; NaN if a force is
/// not finite.
std::vector<KernelLoad> kernel_loads(const Model& model, const Path& point,
                                     const std::vector<int>& parameters, const Linearization& linearization,
                                     const Matrix& tangent_basis, EvaluationCounts& counts);

/// Component in the kernel of the tangent stiffness T^T K T of the force that a change of the parameter
/// causes, relative to its norm: between 0 and 1. If the stiffness is singular, zero means that another path
/// crosses (a pitchfork or transcritical point); any other value means that this path turns back (a fold).
/// `tangent_basis` is T, n x (n - rank). 1 if the force is not finite.
double kernel_share_of_parameter(const Model& model, const Path& point, int traced,
                                 const Linearization& linearization, const Matrix& tangent_basis,
                                 EvaluationCounts& counts);

/// Directions in which paths may leave a branch point: the tangent stiffness T^T K T is singular and the
/// force of the parameter has no component in its kernel. Returns two columns (dx; dp) of size n + 1: the
/// kernel of the stiffness, and the smallest motion that follows a unit change of the parameter. Empty if a
/// number is not finite.
Matrix directions_at_branch_point(const Model& model, const Path& point, int traced,
                                  const Linearization& linearization, const Matrix& tangent_basis,
                                  EvaluationCounts& counts);

}  // namespace eigentrail
