// Newton's method from a guess beside the solution, without damping. A step is accepted where the next
// correction with the same Jacobian is shorter by a quarter (natural monotonicity test: Deuflhard, Newton
// Methods for Nonlinear Problems, 2004, Sect. 3.3). A test of |F| itself, as that of KINSOL's line search,
// allows only short steps where directions of very different stiffness are coupled: a slender beam that turns
// by a step is stretched a little, and the forces of that are far larger than those that the step relieves.
#pragma once

#include "steady/kinsol_solver.hpp"

namespace eigentrail {

/// Solves from u in place; `problem.f_scale` is not used. Only the first `measured` unknowns, times u_scale,
/// count in lengths: the others (multipliers) follow from them. Converged if a correction is shorter than
/// `tolerance` > 0.
NonlinearResult solve_by_whole_steps(const NonlinearProblem& problem, Eigen::Index measured, double tolerance,
                                     int max_iterations, Vector& u);

}  // namespace eigentrail
