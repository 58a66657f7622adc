// Equilibria where the traced parameter is an unknown: pseudo-arclength continuation (Keller 1977).
//
// Near a fold the path cannot be followed in p. The point is then looked for on a plane
//
//     c.x (x - x*) + c.p (p - p*) = distance
//
// across the path, and the distance is the coordinate sigma along the path: x, lambda and p are series in it.
// The steady equations grow by one row and one column, and the bordered system stays regular at a fold.
#pragma once

#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

/// Linear functional that measures progress along the path.
struct PathPlane {
  Vector x;        ///< size n
  double p = 1.0;  ///< per unit of the traced parameter

  double operator()(const Vector& position, double parameter) const {
    return x.dot(position) + p * parameter;
  }
};

/// Equilibrium at the intersection of the path with the plane through the guess (x, p); Newton from there.
/// An empty `lambda` is replaced by the least-squares multipliers at the guess. `p` and the result hold the
/// point found. `parameters` are all parameters, the traced one at its guess.
Equilibrium solve_equilibrium_on(const PathPlane& plane, const Model& model, Vector parameters, int traced,
                                 const Vector& x, const Vector& lambda, const SteadyOptions& options,
                                 double& p, EvaluationCounts& counts);

/// Series of (x, lambda, p) in the plane's coordinate about an equilibrium.
EvaluationFault differentiate_equilibrium_on(const PathPlane& plane, const Model& model,
                                             const Equilibrium& equilibrium, const Vector& parameters,
                                             int traced, int order, Path& path, EvaluationCounts& counts);

/// The force that a change of a parameter by one brings, in its unit.
struct KernelLoad {
  double along_kernel = 0.0;  ///< along the left null vector of the tangent stiffness T^T K T
  double total = 0.0;         ///< its length
};

/// One for each of `parameters` (indices), where the tangent stiffness is singular; NaN where a force is not
/// finite.
std::vector<KernelLoad> kernel_loads(const Model& model, const Path& point,
                                     const std::vector<int>& parameters, const Linearization& linearization,
                                     const Matrix& tangent_basis, EvaluationCounts& counts);

/// How far the force that a change of the parameter brings lies in the kernel of the tangent stiffness T^T K
/// T, between 0 and 1. Where the stiffness is singular, zero means that another path crosses (a pitchfork or
/// a transcritical point), anything else that this one turns back (a fold). `tangent_basis` is T, of size n x
/// (n - rank).
double kernel_share_of_parameter(const Model& model, const Path& point, int traced,
                                 const Linearization& linearization, const Matrix& tangent_basis,
                                 EvaluationCounts& counts);

/// Directions in which paths may leave a point where the tangent stiffness T^T K T is singular and the
/// parameter's force has no share in its kernel: two columns (dx; dp) of size n + 1. The first is the kernel
/// of the stiffness, the second the least motion that follows a unit change of the parameter.
Matrix directions_at_branch_point(const Model& model, const Path& point, int traced,
                                  const Linearization& linearization, const Matrix& tangent_basis,
                                  EvaluationCounts& counts);

}  // namespace eigentrail
