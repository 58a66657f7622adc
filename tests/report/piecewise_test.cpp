#include "report/piecewise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace eigentrail::test::piecewise_test {
namespace {

constexpr double tolerance = 1e-9;

/// Value of a curve at a place: Lagrange's formula on its piece.
Complex at(const PiecewiseCurve& curve, std::size_t degree, double place) {
  std::size_t piece = 0;
  while (piece + 2 < curve.knots.size() && curve.knots[piece + 1] < place) ++piece;
  const double u = (place - curve.knots[piece]) / (curve.knots[piece + 1] - curve.knots[piece]);
  const auto node = [degree](std::size_t j) {
    return 0.5 * (1.0 - std::cos(std::numbers::pi * static_cast<double>(j) / static_cast<double>(degree)));
  };
  Complex sum = 0.0;
  for (std::size_t j = 0; j <= degree; ++j) {
    double factor = 1.0;
    for (std::size_t k = 0; k <= degree; ++k) {
      if (k != j) factor *= (u - node(k)) / (node(j) - node(k));
    }
    sum += factor * curve.values[piece * degree + j];
  }
  return sum;
}

struct Case {
  const char* name;
  Complex (*function)(double x);
  std::vector<double> nodes;
  std::size_t degree;
};

class Piecewise : public testing::TestWithParam<Case> {};

TEST_P(Piecewise, MeetsTheFunctionEverywhere) {
  const auto& [name, function, nodes, degree] = GetParam();
  const auto value = [&function = function, &nodes = nodes](std::size_t i, double t) {
    return function(nodes[i] + t * (nodes[i + 1] - nodes[i]));
  };
  const auto curves = approximate(nodes, value, {degree, tolerance, tolerance, 1e3});
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].knots.front(), nodes.front());
  EXPECT_EQ(curves[0].knots.back(), nodes.back());
  EXPECT_EQ(curves[0].values.size(), (curves[0].knots.size() - 1) * degree + 1);
  for (int i = 0; i <= 1000; ++i) {
    const double x = nodes.front() + (nodes.back() - nodes.front()) * i / 1000.0;
    EXPECT_LT(std::abs(at(curves[0], degree, x) - function(x)), 3.0 * tolerance) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Piecewise,
    testing::Values(
        Case{"OnePolynomial", [](double x) { return Complex(x * x * x, 1.0 - x); }, {0.0, 0.3, 1.0}, 6},
        Case{"Waves", [](double x) { return Complex(std::sin(20.0 * x), std::cos(7.0 * x)); }, {0.0, 1.0}, 6},
        Case{"WavesOfDegreeThree", [](double x) { return Complex(std::sin(3.0 * x), 0.0); }, {0.0, 1.0}, 3},
        Case{"KinkAtANode",
             [](double x) { return Complex(std::abs(x - 0.37), 0.0); },
             {0.0, 0.2, 0.37, 1.0},
             6},
        Case{"RootAtTheEnd", [](double x) { return Complex(0.0, std::sqrt(x)); }, {0.0, 0.1, 1.0}, 6},
        Case{"OnePeakOnOneOfManySteps",
             [](double x) { return Complex(std::exp(-std::pow((x - 0.505) / 2e-3, 2)), 0.0); },
             [] {
               std::vector<double> nodes;
               for (int i = 0; i <= 200; ++i) nodes.push_back(i / 200.0);
               return nodes;
             }(),
             6}),
    [](const auto& test) { return test.param.name; });

TEST(PiecewiseCurves, OnePieceServesManyStepsOfASmoothFunction) {
  const std::vector<double> nodes{0.0, 0.1, 0.2, 0.5, 0.6, 1.0};
  const auto value = [&](std::size_t i, double t) {
    return Complex(nodes[i] + t * (nodes[i + 1] - nodes[i]), 1.0);
  };
  const auto curves = approximate(nodes, value, {6, tolerance, tolerance, 1e3});
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].knots.size(), 2U);
}

TEST(PiecewiseCurves, LeaveAGapWhereTheFunctionIsTooLarge) {
  const std::vector<double> nodes{0.0, 1.0};
  const auto value = [](std::size_t, double t) { return Complex(1.0 / (t - 0.3), 0.0); };
  const auto curves = approximate(nodes, value, {6, tolerance, tolerance, 1e3});
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_NEAR(curves[0].knots.back(), 0.3, 2e-3);
  EXPECT_NEAR(curves[1].knots.front(), 0.3, 2e-3);
  for (const PiecewiseCurve& curve : curves) {
    for (const Complex s : curve.values) EXPECT_LE(std::abs(s), 1e3);
  }
}

TEST(PiecewiseCurves, NothingRemainsOfAFunctionThatIsNoNumber) {
  const auto value = [](std::size_t, double) { return Complex(NAN, 0.0); };
  EXPECT_TRUE(approximate({0.0, 1.0}, value, {6, tolerance, tolerance, 1e3}).empty());
}

TEST(PiecewiseCurves, EndAfterAFewHundredPiecesPerStepOfNoise) {
  const std::vector<double> nodes = {0.0, 1.0, 2.0};
  const auto noise = [](std::size_t i, double t) {
    return Complex(std::sin(1e12 * (static_cast<double>(i) + t)), std::cos(1e13 * t));
  };
  CurveOptions options;
  options.real_tolerance = options.imag_tolerance = tolerance;
  options.largest = 10.0;
  const std::vector<PiecewiseCurve> curves = approximate(nodes, noise, options);
  ASSERT_FALSE(curves.empty());
  EXPECT_LT(curves.front().knots.size(), 1000U);
}

// A step of length 1e-20 behind one of length 1: by rounding its ends are equal.
TEST(PiecewiseSteps, LostInTheLengthOfThePathGiveNumbers) {
  const auto value = [](std::size_t, double t) {
    EXPECT_TRUE(t >= 0.0 && t <= 1.0);
    return Complex(t);
  };
  for (const std::vector<double>& nodes : {std::vector<double>{0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}})
    EXPECT_FALSE(approximate(nodes, value, {4, tolerance, tolerance, 1e3}).empty());
}

}  // namespace
}  // namespace eigentrail::test::piecewise_test
