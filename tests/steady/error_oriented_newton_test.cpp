// Newton's method with the natural monotonicity test, and what it is for: equilibria of slender beams.
#include "steady/error_oriented_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "eigentrail/steady/equilibrium.hpp"
#include "steady/heavy_elastica.hpp"
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
