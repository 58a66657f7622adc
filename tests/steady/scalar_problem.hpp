// Nonlinear problems with one unknown.
#pragma once

#include <memory>

#include "steady/kinsol_solver.hpp"

namespace eigentrail::test {

/// F(u) = f(u) with one unknown.
template <class F, class Slope>
NonlinearProblem scalar_problem(F f, Slope slope) {
  NonlinearProblem problem;
  auto at = std::make_shared<double>(0.0);
  problem.residual = [f](const Vector& u, Vector& value) {
    value = Vector{{f(u[0])}};
    return true;
  };
  problem.factor = [slope, at](const Vector& u) {
    *at = slope(u[0]);
    return true;
  };
  problem.solve = [at](const Vector& b, Vector& du) { du = b / *at; };
  problem.u_scale = problem.f_scale = Vector::Ones(1);
  return problem;
}

}  // namespace eigentrail::test
