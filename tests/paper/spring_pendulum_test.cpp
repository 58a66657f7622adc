// Pendulum with a vertical spring, seed paper Sect. 6.2: Eqs. (109) to (129). The tangent basis turns: T' is
// not zero.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::spring_pendulum_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double g = 9.81;
constexpr double m = 2.0;
constexpr double length = 1.5;

class SpringPendulum : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    k = GetParam() * m * g / length;
    sine = m * g / (k * length);
    cosine = std::sqrt(1.0 - sine * sine);
    setting = scene_setting("spring_pendulum");
    point = point_from_guess(setting.problem(), k, counts);
    node = differentiate_point(setting.problem(), point, counts).value();
  }

  double k = 0.0, sine = 0.0, cosine = 0.0;
  Setting setting;
  RunCounts counts;
  PathPoint point;
  PathNode node;
};

TEST_P(SpringPendulum, EquilibriumFollowsEqs109And114) {
  EXPECT_NEAR(point.equilibrium.x[0], length * cosine, tolerance * length);
  EXPECT_NEAR(point.equilibrium.x[2], -length * sine, tolerance * length);
  EXPECT_NEAR(point.equilibrium.lambda[0], 0.0, tolerance * m * g / length);
}

TEST_P(SpringPendulum, EigenvalueEqualsEq119) {
  const double expected = cosine * std::sqrt(k / m);
  EXPECT_NEAR(point.pairs[0].eigenvalue().imag(), expected, tolerance * expected);
  EXPECT_NEAR(point.pairs[0].eigenvalue().real(), 0.0, tolerance * expected);
}

TEST_P(SpringPendulum, EquilibriumSensitivityEqualsEq121) {
  const double x0 = length * cosine;
  const double z0 = -length * sine;
  EXPECT_NEAR(node.path.x(0, 1), z0 * z0 / (k * x0), tolerance * length / k / cosine);
  EXPECT_NEAR(node.path.x(2, 1), m * g / (k * k), tolerance * length / k);
  EXPECT_NEAR(node.path.lambda(0, 1), 0.0, tolerance * m * g / length / k);
}

TEST_P(SpringPendulum, EigenvalueSensitivityEqualsEqs120And128) {
  const double expected = (1.0 + sine * sine) / (cosine * 2.0 * std::sqrt(m * k));
  EXPECT_NEAR(node.s(0, 1).imag(), expected, tolerance * expected);
  EXPECT_NEAR(node.s(0, 1).real(), 0.0, tolerance * expected);
}

TEST_P(SpringPendulum, ProjectionSensitivityEqualsEqs125And129) {
  const PathProblem problem = setting.problem();
  Linearization linearization;
  ASSERT_FALSE(problem.model.linearize(node.path, 1, linearization, counts.evaluations));
  TangentBasis basis = point.basis;
  differentiate_basis(point.equilibrium.kkt.constraints(), linearization.A, 1, basis);
  ASSERT_EQ(basis.T.size(), 2U);
  // Eq. (129): T' = -(tan theta0 / k) Q1 for Q2 = {sin, cos} and Q1 = {cos, -sin}; T may be -Q2.
  const double sign = basis.T[0](2, 0) > 0.0 ? 1.0 : -1.0;
  EXPECT_NEAR(sign * basis.T[0](0, 0), sine, tolerance);
  EXPECT_NEAR(sign * basis.T[0](2, 0), cosine, tolerance);
  const double rate = sine / cosine / k;
  EXPECT_NEAR(sign * basis.T[1](0, 0), -rate * cosine, tolerance * rate);
  EXPECT_NEAR(sign * basis.T[1](2, 0), rate * sine, tolerance * rate);
  EXPECT_NEAR(basis.T[1](1, 0), 0.0, tolerance * rate);

  const ReducedPencil pencil = reduce(linearization, basis, 1);
  EXPECT_NEAR(pencil.K[0](0, 0), k * cosine * cosine, tolerance * k);  // (117c)
  EXPECT_NEAR(pencil.K[1](0, 0), 1.0 + sine * sine, tolerance);        // (126c)
  if (pencil.M.size() > 1) {
    EXPECT_NEAR(pencil.M[1](0, 0), 0.0, tolerance * m / k);
  }
}

TEST_P(SpringPendulum, FrozenProjectionGivesTheWrongSensitivity) {
  // For comparison, with T' = 0 the term 2 sin^2 is missing in K', and (126c) is not reproduced.
  const PathProblem problem = setting.problem();
  Linearization linearization;
  ASSERT_FALSE(problem.model.linearize(node.path, 1, linearization, counts.evaluations));
  const ReducedPencil pencil = reduce(linearization, point.basis, 1);
  EXPECT_NEAR(pencil.K[1](0, 0), cosine * cosine, tolerance);
  const PairSeries frozen = differentiate_pair(pencil, point.pairs[0], 1, counts.modes);
  const double expected = (1.0 + sine * sine) / (cosine * 2.0 * std::sqrt(m * k));
  EXPECT_GT(std::abs(frozen.Lambda[1](0, 0).imag() - expected), 0.1 * expected * sine * sine);
}

INSTANTIATE_TEST_SUITE_P(Stiffness, SpringPendulum, testing::Values(1.05, 1.5, 2.0, 10.0));

}  // namespace
}  // namespace eigentrail::test::spring_pendulum_test
