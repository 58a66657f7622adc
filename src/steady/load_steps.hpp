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

}  // namespace eigentrail
