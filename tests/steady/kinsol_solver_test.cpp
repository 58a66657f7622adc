#include "steady/kinsol_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace eigentrail::test::kinsol_solver_test {
namespace {

/// atan(u) = 0: Newton's method without damping diverges from |u| > 1.39.
NonlinearProblem arctangent(double& slope) {
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
  problem.u_scale = Vector::Ones(1);
  problem.f_scale = Vector::Ones(1);
  return problem;
}

TEST(KinsolSolver, LineSearchConvergesWherePlainNewtonDiverges) {
  double slope = 0.0;
  Vector u{{3.0}};
  EXPECT_TRUE(solve_with_kinsol(arctangent(slope), 1e-12, 100, u).converged);
  EXPECT_NEAR(u[0], 0.0, 1e-11);

  double plain = 3.0;
  for (int i = 0; i < 5; ++i) plain -= std::atan(plain) * (1.0 + plain * plain);
  EXPECT_GT(std::abs(plain), 1e3);
}

TEST(KinsolSolver, GivesAReasonWhenThereIsNoRoot) {
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
  const NonlinearResult result = solve_with_kinsol(problem, 1e-12, 50, u);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.message.find("KIN_"), std::string::npos) << result.message;
}

TEST(KinsolSolver, PassesAnExceptionThroughTheCLibrary) {
  double slope = 0.0;
  NonlinearProblem problem = arctangent(slope);
  problem.residual = [](const Vector&, Vector&) -> bool { throw std::domain_error("from the model"); };
  Vector u{{1.0}};
  EXPECT_THROW(solve_with_kinsol(problem, 1e-12, 50, u), std::domain_error);
}

TEST(KinsolSolver, ShortensTheStepWhereTheResidualIsNotDefined) {
  // log(u) = 0 from u = 3: the full Newton step lands at a negative u.
  NonlinearProblem problem;
  problem.residual = [](const Vector& u, Vector& f) {
    if (u[0] <= 0.0) return false;
    f = u.array().log();
    return true;
  };
  double slope = 0.0;
  problem.factor = [&](const Vector& u) {
    slope = 1.0 / u[0];
    return true;
  };
  problem.solve = [&](const Vector& b, Vector& du) { du = b / slope; };
  problem.u_scale = problem.f_scale = Vector::Ones(1);
  Vector u{{3.0}};
  EXPECT_TRUE(solve_with_kinsol(problem, 1e-12, 50, u).converged);
  EXPECT_NEAR(u[0], 1.0, 1e-11);
}

}  // namespace
}  // namespace eigentrail::test::kinsol_solver_test
