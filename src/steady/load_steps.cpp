#include "steady/load_steps.hpp"

#include <algorithm>
#include <optional>

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

namespace {

/// Share of the load in the first step; a shorter step than the least one does not lead to a solution.
constexpr double first_share = 0.05, least_share = 1e-4;
/// Newton iterations of all steps together.
constexpr int most_load_iterations = 200;
/// Newton iterations in one step, of which the first shows how good the prediction is; more mean that it is
/// too long.
constexpr int most_in_one_step = 6;
/// With at most so many iterations the next step is longer.
constexpr int few_iterations = 3;
constexpr double growth = 2.0;
/// Accuracy of places on the way: what is left there is corrected with the next one.
constexpr double on_the_way = 1e-5;
/// Corrections at the whole load are shorter than this.
constexpr double at_the_end = 1e-8;

/// A place on the way, with its slope.
struct Place {
  double t = 0.0;
  Vector u, slope;
};

/// The cubic through two places, at t; the tangent if there is one place only.
Vector predicted(const std::optional<Place>& before, const Place& last, double t) {
  if (!before) return last.u + (t - last.t) * last.slope;
  const double h = last.t - before->t, x = (t - before->t) / h;
  const double a = x * x * (3.0 - 2.0 * x), b = x * (x - 1.0) * (x - 1.0), c = x * x * (x - 1.0);
  return (1.0 - a) * before->u + a * last.u + h * (b * before->slope + c * last.slope);
}

}  // namespace

NonlinearResult solve_in_load_steps(const NonlinearProblem& problem, Eigen::Index measured, Vector& u) {
  NonlinearResult result;
  Vector load;
  Place last{0.0, u, {}};
  const auto find_slope = [&](Place& place) {
    if (!problem.factor(place.u)) return false;
    problem.solve(-load, place.slope);
    return place.slope.allFinite();
  };
  if (!problem.residual(u, load) || !find_slope(last)) {
    result.message = "the slope at the guess is not finite";
    return result;
  }
  std::optional<Place> before;
  NonlinearProblem held = problem;
  double step = first_share;
  while (last.t < 1.0) {
    if (step < least_share || result.iterations >= most_load_iterations) {
      result.message = "no solution beyond " + std::to_string(last.t) + " of the load";
      return result;
    }
    Place next{std::min(1.0, last.t + step), {}, {}};
    if (1.0 - next.t < 0.1 * step) next.t = 1.0;
    next.u = predicted(before, last, next.t);
    held.residual = [&](const Vector& v, Vector& f) {
      if (!problem.residual(v, f)) return false;
      f -= (1.0 - next.t) * load;
      return true;
    };
    const double tolerance = next.t < 1.0 ? on_the_way : at_the_end;
    const NonlinearResult found = solve_by_whole_steps(held, measured, tolerance, most_in_one_step, next.u);
    result.iterations += std::max(1, found.iterations);
    if (!found.converged || (next.t < 1.0 && !find_slope(next))) {
      step *= 0.5;
      continue;
    }
    if (found.iterations <= few_iterations) step *= growth;
    before = std::move(last);
    last = std::move(next);
    u = last.u;
  }
  result.converged = true;
  return result;
}

}  // namespace eigentrail
