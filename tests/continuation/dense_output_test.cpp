#include "eigentrail/continuation/dense_output.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace eigentrail {
namespace {

/// Taylor coefficients of 1 / (z - p) about p0.
ComplexMatrix pole_series(Complex z, double p0, int order) {
  ComplexMatrix series(1, order + 1);
  for (int k = 0; k <= order; ++k) series(0, k) = std::pow(z - p0, -(k + 1));
  return series;
}

/// Taylor coefficients of sqrt(p - z), the singularity at an exceptional point.
ComplexMatrix root_series(Complex z, double p0, int order) {
  ComplexMatrix series(1, order + 1);
  Complex binomial = 1.0;
  for (int k = 0; k <= order; ++k) {
    series(0, k) = binomial * std::pow(p0 - z, 0.5 - k);
    binomial *= (0.5 - k) / (k + 1.0);
  }
  return series;
}

ComplexMatrix exponential_series(double p0, int order) {
  ComplexMatrix series(1, order + 1);
  double factorial = 1.0;
  for (int k = 0; k <= order; ++k) {
    series(0, k) = std::exp(Complex(0.3, 1.0) * p0) * std::pow(Complex(0.3, 1.0), k) / factorial;
    factorial *= k + 1;
  }
  return series;
}

class DenseOutput : public testing::TestWithParam<int> {};

TEST_P(DenseOutput, PolynomialsUpToItsDegreeAreExact) {
  const int q = GetParam();
  const int degree = 2 * q + 1;
  const auto series = [&](double p0) {  // sum_j (j + 1) p^j
    ComplexMatrix coefficients = ComplexMatrix::Zero(1, q + 1);
    for (int j = 0; j <= degree; ++j) {
      double binomial = 1.0;
      for (int k = 0; k <= std::min(j, q); ++k) {
        coefficients(0, k) += (j + 1.0) * binomial * std::pow(p0, j - k);
        binomial *= (j - k) / (k + 1.0);
      }
    }
    return coefficients;
  };
  const HermiteInterpolant interpolant(0.4, series(0.4), -0.7, series(-0.7));
  for (const double p : {-0.7, -0.3, 0.1, 0.4, 0.9}) {
    double expected = 0.0;
    for (int j = 0; j <= degree; ++j) expected += (j + 1.0) * std::pow(p, j);
    EXPECT_NEAR(interpolant(p)[0].real(), expected, 1e-12 * std::max(1.0, std::abs(expected)));
  }
}

TEST_P(DenseOutput, ErrorHasOrder2qPlus2) {
  const int q = GetParam();
  const auto error = [&](double h) {
    const HermiteInterpolant interpolant(0.0, exponential_series(0.0, q), h, exponential_series(h, q));
    return std::abs(interpolant(h / 2)[0] - std::exp(Complex(0.3, 1.0) * h / 2.0));
  };
  EXPECT_NEAR(std::log2(error(2.0) / error(1.0)), 2.0 * q + 2.0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Orders, DenseOutput, testing::Range(1, 5));

struct ErrorCase {
  std::string name;
  std::function<ComplexMatrix(double, int)> series;
  std::function<Complex(double)> exact;
};

class DenseOutputError : public testing::TestWithParam<std::tuple<ErrorCase, int>> {};

/// The estimate from the decay of the terms stays within a small factor of the true error, also on steps as
/// long as the distance to the singularity, where an estimate from the previous step fails.
TEST_P(DenseOutputError, IsToldByTheDecayOfTheTerms) {
  const auto& [function, q] = GetParam();
  for (const double h : {0.1, 0.3, 1.0, 2.0}) {
    const HermiteInterpolant step(0.0, function.series(0.0, q), h, function.series(h, q));
    double error = 0.0;
    for (int i = 1; i < 100; ++i)
      error = std::max(error, std::abs(step(h * i / 100.0)[0] - function.exact(h * i / 100.0)));
    if (error < 1e-13) continue;
    const double estimate = step.estimated_error()[0];
    EXPECT_GT(estimate, 0.4 * error) << "h = " << h;
    EXPECT_LT(estimate, 10.0 * error) << "h = " << h;
  }
}

const Complex ahead(2.5, 0.4);
INSTANTIATE_TEST_SUITE_P(
    Functions, DenseOutputError,
    testing::Combine(
        testing::Values(ErrorCase{"PoleAhead", [](double p, int q) { return pole_series(ahead, p, q); },
                                  [](double p) { return 1.0 / (ahead - p); }},
                        ErrorCase{"RootAhead", [](double p, int q) { return root_series(ahead, p, q); },
                                  [](double p) { return std::sqrt(p - ahead); }},
                        ErrorCase{"PoleAside",
                                  [](double p, int q) {
                                    return pole_series({0.5, 1.2}, p, q);
                                  },
                                  [](double p) { return 1.0 / (Complex(0.5, 1.2) - p); }}),
        testing::Range(2, 5)),
    [](const auto& info) {
      return std::get<0>(info.param).name + "Order" + std::to_string(std::get<1>(info.param));
    });

TEST(DenseOutputRival, MissOfThePreviousStepUnderestimatesNearASingularity) {
  const int q = 3;
  const auto series = [&](double p) { return root_series(2.2, p, q); };
  const HermiteInterpolant last(0.0, series(0.0), 1.0, series(1.0));
  const HermiteInterpolant step(1.0, series(1.0), 2.0, series(2.0));
  const double miss = std::abs(last(2.0)[0] - series(2.0)(0, 0)) * std::pow(0.25 / 2.0, q + 1);
  double error = 0.0;
  for (int i = 1; i < 100; ++i) {
    const double p = 1.0 + i / 100.0;
    error = std::max(error, std::abs(step(p)[0] - series(p)(0, 0)));
  }
  EXPECT_LT(miss, 0.1 * error);
  EXPECT_GT(step.estimated_error()[0], 0.4 * error);
}

}  // namespace
}  // namespace eigentrail
