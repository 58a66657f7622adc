#include "steady/whole_newton_steps.hpp"

namespace eigentrail {

NonlinearResult solve_by_whole_steps(const NonlinearProblem& problem, Eigen::Index measured, double tolerance,
                                     int max_iterations, Vector& u) {
  constexpr double shorter = 0.75;
  const auto size = [&](const Vector& du) {
    return problem.u_scale.head(measured).cwiseProduct(du.head(measured)).norm();
  };
  // With the Jacobian that was factored last.
  const auto correct = [&problem](const Vector& at, Vector& correction) {
    Vector f;
    if (!problem.residual(at, f)) return false;
    problem.solve(-f, correction);
    return correction.allFinite();
  };
  NonlinearResult result;
  Vector du, next;
  for (; result.iterations < max_iterations; ++result.iterations) {
    if (!problem.factor(u) || !correct(u, du)) {
      result.message = "a correction is not finite";
      return result;
    }
    const double length = size(du);
    u += du;
    if (length <= tolerance) {
      result.converged = true;
      return result;
    }
    if (!correct(u, next) || !(size(next) <= shorter * length)) {
      u -= du;
      result.message = "the step along the correction does not lead closer to a solution";
      return result;
    }
  }
  result.message = "still moving after " + std::to_string(result.iterations) + " iterations";
  return result;
}

}  // namespace eigentrail
