#include "accuracy/grid_interpolant.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace eigentrail::test::grid_interpolant_test {
namespace {

Complex function(double p) {
  return {std::sin(p), std::exp(-p)};
}

std::vector<ComplexVector> sampled(double first, double step, int points, Complex (*f)(double)) {
  std::vector<ComplexVector> values;
  for (int i = 0; i < points; ++i) values.push_back(ComplexVector::Constant(1, f(first + i * step)));
  return values;
}

/// Largest error of the interpolant on [0, 3].
double error_with(int points, Interpolation kind) {
  const double step = 3.0 / (points - 1);
  const GridInterpolant interpolant(0.0, step, sampled(0.0, step, points, function), kind);
  double worst = 0.0;
  for (int i = 0; i <= 3000; ++i) {
    const double p = i * 1e-3;
    worst = std::max(worst, std::abs(interpolant(p)[0] - function(p)));
  }
  return worst;
}

TEST(GridInterpolant, StraightLinesAreOfSecondOrder) {
  const double order =
      std::log2(error_with(41, Interpolation::linear) / error_with(81, Interpolation::linear));
  EXPECT_NEAR(order, 2.0, 0.1);
}

TEST(GridInterpolant, SplinesAreOfFourthOrderUpToTheEnds) {
  const double order =
      std::log2(error_with(41, Interpolation::cubic_spline) / error_with(81, Interpolation::cubic_spline));
  EXPECT_NEAR(order, 4.0, 0.25);
}

TEST(GridInterpolant, ReproducesCubicsForEveryNumberOfPointsAndEitherDirection) {
  const auto cubic = [](double p) { return Complex(1.0 + p * (2.0 + p * (-3.0 + p)), p * p); };
  for (int points = 5; points < 12; ++points) {
    for (const double step : {0.3, -0.3}) {
      const GridInterpolant spline(1.0, step, sampled(1.0, step, points, cubic), Interpolation::cubic_spline);
      for (int i = 0; i <= 20; ++i) {
        const double p = 1.0 + step * (points - 1) * i / 20.0;
        EXPECT_LT(std::abs(spline(p)[0] - cubic(p)), 1e-13) << points << " points, step " << step;
      }
    }
  }
}

TEST(GridInterpolant, RefusesTooFewPoints) {
  EXPECT_THROW(GridInterpolant(0.0, 1.0, sampled(0.0, 1.0, 4, function), Interpolation::cubic_spline),
               std::invalid_argument);
}

}  // namespace
}  // namespace eigentrail::test::grid_interpolant_test
