// Newton's method with damping by the natural monotonicity test (Deuflhard, Newton Methods for Nonlinear
// Problems, 2004, algorithm NLEQ-ERR): a step is accepted where the next correction with the same Jacobian,
//
//     |J(u)^-1 F(u + t du)| <= (1 - t/4) |du|,
//
// is shorter. A test of |F| itself, as that of KINSOL's line search, allows only short steps where directions
// of very different stiffness are coupled: a slender beam that turns by a step is stretched a little, and the
// forces of that are far larger than those that the step relieves.
#pragma once

#include "steady/kinsol_solver.hpp"

namespace eigentrail {

struct ErrorOrientedOptions {
  double tolerance = 1e-8;   ///< converged if a correction is shorter, > 0
  int max_iterations = 200;  ///< >= 1
  /// A step that has to be shorter than this share of the correction does not lead to a solution. 1: only
  /// whole steps, from a guess beside the solution; another solution farther away is not found then.
  double least_damping = 1e-6;
};

/// Solves from u in place; `problem.f_scale` is not used. Only the first `measured` unknowns, times u_scale,
/// count in lengths: the others (multipliers) follow from them.
NonlinearResult solve_error_oriented(const NonlinearProblem& problem, Eigen::Index measured,
                                     const ErrorOrientedOptions& options, Vector& u);

}  // namespace eigentrail
