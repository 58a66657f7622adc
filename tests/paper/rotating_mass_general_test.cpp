// Rotating point mass in general position against 60-digit reference values (rotating_mass_reference.hpp).
#include <gtest/gtest.h>

#include <cmath>

#include "paper/rotating_mass_reference.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::rotating_mass_general_test {
namespace {

constexpr double value_tolerance = 1e-12;  // x0, lambda0, s
constexpr double second_tolerance = 1e-9;  // s', s''
constexpr double fourth_tolerance = 1e-6;  // s''', s''''
constexpr double hinge = 1.0;

double factorial(int k) {
  return std::tgamma(k + 1.0);
}

/// The point at a speed, reached by tracing from 100 rad/s: at low speed the guess lies far from the branch.
class GeneralPosition : public testing::TestWithParam<std::size_t> {
 protected:
  const RotatingMassReference& lag() const { return rotating_mass_r2[2 * GetParam()]; }
  const RotatingMassReference& flap() const { return rotating_mass_r2[2 * GetParam() + 1]; }

  PathNode node_at(double omega) const {
    if (omega == 100.0) {
      Setting setting = scene_setting("rotating_mass", {{"order", "4"}});
      return record_trace(setting).nodes.front();
    }
    Setting setting = scene_setting("rotating_mass", {{"order", "4"}, {"to", std::to_string(omega)}});
    return record_trace(setting).nodes.back();
  }
};

TEST_P(GeneralPosition, EquilibriumAgreesToTwelveDigits) {
  const PathNode node = node_at(lag().omega);
  const Vector expected{{lag().x[0] + hinge, lag().x[1], lag().x[2]}};
  EXPECT_LT((node.path.x.col(0) - expected).norm(), value_tolerance * expected.norm());
  EXPECT_NEAR(node.path.lambda(0, 0), lag().lambda, value_tolerance * lag().lambda);
}

TEST_P(GeneralPosition, EigenvaluesAndDerivativesAgree) {
  const PathNode node = node_at(lag().omega);
  ASSERT_EQ(node.tracks.size(), 2U);
  for (const auto& [row, reference] : {std::pair(0, &lag()), std::pair(1, &flap())}) {
    const double tolerances[] = {value_tolerance, second_tolerance, second_tolerance, fourth_tolerance,
                                 fourth_tolerance};
    for (int k = 0; k <= 4; ++k) {
      const Complex expected = reference->derivative(k);
      const Complex found = node.s(static_cast<std::size_t>(row), k) * factorial(k);
      EXPECT_LT(std::abs(found - expected), tolerances[k] * std::abs(expected))
          << "mode " << row << " order " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TwelveSpeeds, GeneralPosition, testing::Range(std::size_t{0}, std::size_t{12}));

TEST(RotatingMass, SensitivitiesWithTenfoldDragAgree) {
  Setting setting =
      scene_setting("rotating_mass", {{"order", "4"}, {"to", "40"}}, {{"value = 2.0", "value = 20.0"}});
  const PathNode node = record_trace(setting).nodes.back();
  for (int row = 0; row < 2; ++row) {
    for (int k = 0; k <= 4; ++k) {
      const Complex expected = rotating_mass_r20[static_cast<std::size_t>(row)].derivative(k);
      const double tolerance = k == 0 ? value_tolerance : k <= 2 ? second_tolerance : fourth_tolerance;
      const Complex found = node.s(static_cast<std::size_t>(row), k) * factorial(k);
      EXPECT_LT(std::abs(found - expected), tolerance * std::abs(expected));
    }
  }
}

/// Reading A_/p in Eqs. (36), (67) as a partial derivative, zero here, must fail, by as much as is known.
TEST(RotatingMass, LiteralPartialDerivativeOfConstraintsIsWrong) {
  for (const auto& [omega, expected_error] : literal_reading_error) {
    Setting setting = scene_setting("rotating_mass", {{"to", std::to_string(omega)}});
    PathProblem problem = setting.problem();
    const PathNode node = record_trace(setting).nodes.back();
    RunCounts counts;
    counts.evaluations = setting.model->new_counts();
    Prediction prediction{omega, {node.path.x.col(0), node.path.lambda.col(0), true}, {}};
    for (const Track& track : node.tracks) {
      prediction.pairs.push_back(track.pair);
      prediction.pairs.back().Z = track.series.Z[0];
    }
    const PathPoint point = compute_point(problem, prediction, node.basis.T[0], counts);
    ASSERT_EQ(point.status, PointStatus::computed);
    Linearization linearization;
    ASSERT_FALSE(setting.model->linearize(node.path, 1, linearization, counts.evaluations));
    const ReducedPencil literal = reduce(linearization, point.basis, 1);  // T' = 0
    const Complex wrong = differentiate_pair(literal, point.pairs[0], 1, counts.modes).Lambda[1](0, 0);
    EXPECT_NEAR(std::abs(wrong - node.s(0, 1)) / std::abs(node.s(0, 1)), expected_error,
                0.01 * expected_error)
        << "omega = " << omega;
  }
}

}  // namespace
}  // namespace eigentrail::test::rotating_mass_general_test
