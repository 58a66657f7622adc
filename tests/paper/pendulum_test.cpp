// Point mass pendulum, seed paper Sect. 6.1: Eqs. (72) to (106).
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.hpp"

namespace eigentrail::test::pendulum_test {
namespace {

constexpr double tolerance = 1e-12;  // relative, of every closed form
constexpr double g = 9.81;
constexpr double m = 2.0;

class Pendulum : public testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    length = GetParam();
    setting = scene_setting("pendulum");
    point = point_from_guess(setting.problem(), length, counts);
  }

  /// Sensitivities to a parameter at the point.
  PathNode sensitivity(const std::string& parameter) {
    return differentiate_point(setting.problem(), point, setting.parameter(parameter), counts).value();
  }

  double length = 0.0;
  Setting setting;
  RunCounts counts;
  PathPoint point;
};

TEST_P(Pendulum, MultiplierEqualsEq72) {
  EXPECT_NEAR(point.equilibrium.lambda[0], m * g / (2.0 * length), tolerance * m * g / (2.0 * length));
  EXPECT_NEAR(point.equilibrium.x[2], -length, tolerance * length);
}

TEST_P(Pendulum, EigenvalueEqualsEq76) {
  ASSERT_EQ(point.pairs.size(), 1U);
  const double expected = std::sqrt(g / length);
  EXPECT_NEAR(point.pairs[0].eigenvalue().imag(), expected, tolerance * expected);
  EXPECT_NEAR(point.pairs[0].eigenvalue().real(), 0.0, tolerance * expected);
}

TEST_P(Pendulum, ModeShapeIsHorizontalAsEq77) {
  const ComplexVector v = point.shapes(0).col(0).normalized();
  EXPECT_NEAR(std::abs(v[0]), 1.0, tolerance);
}

TEST_P(Pendulum, SensitivityToGravityEqualsEqs93To99) {
  const PathNode node = sensitivity("g");
  const double expected = 1.0 / (2.0 * std::sqrt(g * length));
  EXPECT_NEAR(node.s(0, 1).imag(), expected, tolerance * expected);
  EXPECT_NEAR(node.s(0, 1).real(), 0.0, tolerance * expected);
  EXPECT_LT(node.path.x.col(1).norm(), tolerance * length / g);  // x0_/p = 0, Eq. (95)
  EXPECT_NEAR(node.path.lambda(0, 1), m / (2.0 * length), tolerance * m / (2.0 * length));
}

TEST_P(Pendulum, SensitivityToLengthEqualsEqs100To106) {
  const PathNode node = sensitivity("length");
  const double expected = -std::sqrt(g / length) / (2.0 * length);
  EXPECT_NEAR(node.s(0, 1).imag(), expected, tolerance * std::abs(expected));
  EXPECT_NEAR(node.path.x(0, 1), 0.0, tolerance);
  EXPECT_NEAR(node.path.x(2, 1), -1.0, tolerance);
  const double lambda = -m * g / (2.0 * length * length);
  EXPECT_NEAR(node.path.lambda(0, 1), lambda, tolerance * std::abs(lambda));
}

TEST_P(Pendulum, ReducedStiffnessFollowsEqs87And103) {
  EXPECT_NEAR(point.pencil.M[0](0, 0), m, tolerance * m);
  EXPECT_NEAR(point.pencil.K[0](0, 0), m * g / length, tolerance * m * g / length);
}

TEST_P(Pendulum, HigherDerivativesInLengthFollowThePowerLaw) {
  const PathNode node = sensitivity("length");
  // s = j sqrt(g) length^(-1/2): Taylor coefficients are binomial.
  double expected = std::sqrt(g / length);
  for (int k = 1; k <= setting.options.order.value_or(usual_order); ++k) {
    expected *= (-0.5 - (k - 1)) / k / length;
    EXPECT_NEAR(node.s(0, k).imag(), expected, 1e-11 * std::abs(expected)) << "order " << k;
  }
}

TEST_P(Pendulum, MassHasNoInfluenceOnTheEigenvalue) {
  EXPECT_LT(std::abs(sensitivity("mass").s(0, 1)), tolerance * std::sqrt(g / length) / m);
}

TEST_P(Pendulum, SeveralParametersReuseTheFactorizations) {
  const auto lu = counts.modes.factorizations;
  const auto kkt = counts.equilibrium_factorizations;
  for (const char* parameter : {"g", "length", "mass"}) (void)sensitivity(parameter);
  EXPECT_EQ(counts.modes.factorizations, lu);
  EXPECT_EQ(counts.equilibrium_factorizations, kkt);
}

INSTANTIATE_TEST_SUITE_P(Lengths, Pendulum, testing::Values(0.01, 0.5, 1.5, 5.0, 1000.0));

}  // namespace
}  // namespace eigentrail::test::pendulum_test
