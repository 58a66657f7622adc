#include "steady/kinsol_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "steady/scalar_problem.hpp"

namespace eigentrail::test::kinsol_solver_test {
namespace {

TEST(KinsolSolver, LineSearchConvergesWherePlainNewtonDiverges) {
  Vector u{{3.0}};
  EXPECT_TRUE(solve_with_kinsol(arctangent(), 1e-12, 100, u).converged);
  EXPECT_NEAR(u[0], 0.0, 1e-11);

  double plain = 3.0;
  for (int i = 0; i < 5; ++i) plain -= std::atan(plain) * (1.0 + plain * plain);
  EXPECT_GT(std::abs(plain), 1e3);
}

TEST(KinsolSolver, GivesAReasonWhenThereIsNoRoot) {
  Vector u{{1.0}};
  const NonlinearResult result = solve_with_kinsol(square_and_one(), 1e-12, 50, u);
  EXPECT_FALSE(result.converged);
  EXPECT_NE(result.message.find("KIN_"), std::string::npos) << result.message;
}

TEST(KinsolSolver, PassesAnExceptionThroughTheCLibrary) {
  NonlinearProblem problem = arctangent();
  problem.residual = [](const Vector&, Vector&) -> bool { throw std::domain_error("from the model"); };
  Vector u{{1.0}};
  EXPECT_THROW(solve_with_kinsol(problem, 1e-12, 50, u), std::domain_error);
}

TEST(KinsolSolver, ShortensTheStepWhereTheResidualIsNotDefined) {
  // log(u) = 0 from u = 3: the full Newton step lands at a negative u.
  NonlinearProblem problem =
      scalar_problem([](double u) { return std::log(u); }, [](double u) { return 1.0 / u; });
  problem.residual = [](const Vector& u, Vector& f) {
    if (u[0] <= 0.0) return false;
    f = u.array().log();
    return true;
  };
  Vector u{{3.0}};
  EXPECT_TRUE(solve_with_kinsol(problem, 1e-12, 50, u).converged);
  EXPECT_NEAR(u[0], 1.0, 1e-11);
}

}  // namespace
}  // namespace eigentrail::test::kinsol_solver_test
