// Nonlinear problems with one unknown.
#pragma once

#include <cmath>
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

/// atan(u) = 0: Newton's method without damping diverges from |u| > 1.39.
inline NonlinearProblem arctangent() {
  return scalar_problem([](double u) { return std::atan(u); }, [](double u) { return 1.0 / (1.0 + u * u); });
}

/// u^2 + 1 = 0, without a root.
inline NonlinearProblem square_and_one() {
  return scalar_problem([](double u) { return u * u + 1.0; }, [](double u) { return 2.0 * u; });
}

}  // namespace eigentrail::test
