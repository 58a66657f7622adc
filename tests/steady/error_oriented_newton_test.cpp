// Newton's method with the natural monotonicity test, and what it is for: equilibria of slender beams.
#include "steady/error_oriented_newton.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "eigentrail/steady/equilibrium.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
namespace {

TEST(ErrorOrientedNewton, DampsWherePlainNewtonDiverges) {
  double slope = 0.0;
  NonlinearProblem problem;
  problem.residual = [](const Vector& u, Vector& f) {
    f = u.array().atan();
    return true;
  };
  problem.factor = [&slope](const Vector& u) {
    slope = 1.0 / (1.0 + u[0] * u[0]);
    return true;
  };
  problem.solve = [&slope](const Vector& b, Vector& du) { du = b / slope; };
  problem.u_scale = problem.f_scale = Vector::Ones(1);
  Vector u{{20.0}};
  Vector whole_steps = u;
  EXPECT_FALSE(solve_error_oriented(problem, 1, {.least_damping = 1.0}, whole_steps).converged);
  EXPECT_TRUE(solve_error_oriented(problem, 1, {.tolerance = 1e-10, .max_iterations = 50}, u).converged);
  EXPECT_NEAR(u[0], 0.0, 1e-9);
}

TEST(ErrorOrientedNewton, GivesAReasonWhenThereIsNoRoot) {
  NonlinearProblem problem;
  problem.residual = [](const Vector& u, Vector& f) {
    f = Vector{{u[0] * u[0] + 1.0}};
    return true;
  };
  double slope = 0.0;
  problem.factor = [&](const Vector& u) {
    slope = 2.0 * u[0];
    return true;
  };
  problem.solve = [&](const Vector& b, Vector& du) { du = b / slope; };
  problem.u_scale = problem.f_scale = Vector::Ones(1);
  Vector u{{1.0}};
  const NonlinearResult result =
      solve_error_oriented(problem, 1, {.tolerance = 1e-10, .max_iterations = 50}, u);
  EXPECT_FALSE(result.converged);
  EXPECT_FALSE(result.message.empty());
}

/// Tip of an inextensible cantilever of length 1 and EI = 1 under its weight w: the heavy elastica EI t'' =
/// -w (1 - s) cos t with t(0) = 0 and t'(1) = 0, by shooting with the classical Runge-Kutta method.
Vector heavy_elastica(double w) {
  const auto shoot = [w](double curvature, Vector& tip) {
    constexpr int steps = 2000;
    const double h = 1.0 / steps;
    const auto slope = [w](double s, const Vector& y) {
      return Vector{{y[1], -w * (1.0 - s) * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])}};
    };
    Vector y{{0.0, curvature, 0.0, 0.0}};
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const Vector a = slope(s, y), b = slope(s + 0.5 * h, y + 0.5 * h * a);
      const Vector c = slope(s + 0.5 * h, y + 0.5 * h * b), d = slope(s + h, y + h * c);
      y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    tip = y.tail(2);
    return y[1];
  };
  // The least curvature at the root belongs to the beam that does not wind up.
  Vector tip;
  double low = 0.0, high = 0.01 * w;
  while (shoot(high, tip) < 0.0) {
    low = high;
    high += 0.01 * w;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (shoot(middle, tip) < 0.0 ? low : high) = middle;
  }
  return tip;
}

TEST(ErrorOrientedNewton, FindsTheEquilibriumOfASlenderBeamUnderItsWeight) {
  const double weight = 2.5;  // at 3 and 3.2 rounding decides, and some processors relax
  const Setting setting =
      scene_setting("rotating_cantilever", {},
                    {{"elements     = 10", "elements = 40"},
                     {"lag     = 20.0", "lag = 20.0\nweight = " + std::to_string(weight)},
                     {"[[beam]] ", "[gravity]\nacceleration = [0, 0, \"-weight\"]\n[[beam]] "}});
  EvaluationCounts counts = setting.model->new_counts();
  const Vector parameters = setting.problem().parameters;
  const Equilibrium found =
      solve_equilibrium(*setting.model, parameters, setting.model->initial_guess(parameters), Vector(),
                        SteadyOptions(), counts);
  ASSERT_EQ(found.status, SteadyStatus::converged) << found.report.message;
  EXPECT_FALSE(found.report.relaxed);
  EXPECT_LT(found.report.iterations, 200);
  const Vector tip = heavy_elastica(weight);
  const Eigen::Index at = setting.model->n_coordinates() - 12;  // origin of the last node
  EXPECT_NEAR(found.x[at], tip[0], 1e-4);
  EXPECT_NEAR(found.x[at + 2], -std::abs(tip[1]), 1e-4);
}

}  // namespace
}  // namespace eigentrail::test
