// An equilibrium far from the guess, by adding the load in steps. The forces F(u0) that are out of balance at
// the guess u0 are held at first and then released:
//
//     F(u) = (1 - t) F(u0),    t = 0 ... 1
//
// (the Newton homotopy; Keller, Global homotopies and Newton methods, 1978). For a beam that is straight in
// the guess and bends under its weight, t is the share of the weight. Each step is predicted from the last
// two places with their slopes, u' = -J(u)^-1 F(u0), and corrected by Newton's method with whole steps. So
// what the stiff directions need follows from places at which they are in balance, and steps are far longer
// than those of damped iterations from the guess.
#pragma once

#include "steady/kinsol_solver.hpp"

namespace eigentrail {

/// Solves from u in place; `problem.f_scale` is not used. Only the first `measured` unknowns, times u_scale,
/// count in lengths. After a failure u is the last place.
NonlinearResult solve_in_load_steps(const NonlinearProblem& problem, Eigen::Index measured, Vector& u);

// Newton's method from a guess beside the solution, without damping. A step is accepted where the next
// correction with the same Jacobian is shorter by a quarter (natural monotonicity test: Deuflhard, Newton
// Methods for Nonlinear Problems, 2004, Sect. 3.3). A test of |F| itself, as that of KINSOL's line search,
// allows only short steps where directions of very different stiffness are coupled: a slender beam that turns
// by a step is stretched a little, and the forces of that are far larger than those that the step relieves.

/// Solves from u in place; `problem.f_scale` is not used. Only the first `measured` unknowns, times u_scale,
/// count in lengths: the others (multipliers) follow from them. Converged if a correction is shorter than
/// `tolerance` > 0.
NonlinearResult solve_by_whole_steps(const NonlinearProblem& problem, Eigen::Index measured, double tolerance,
                                     int max_iterations, Vector& u);

}  // namespace eigentrail
