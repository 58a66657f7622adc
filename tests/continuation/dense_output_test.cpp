#include "eigentrail/continuation/dense_output.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace eigentrail::test::dense_output_test {
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
  const double length = -0.7 - 0.4;
  const HermiteInterpolant interpolant(length, series(0.4), series(-0.7));
  for (const double p : {-0.7, -0.3, 0.1, 0.4, 0.9}) {
    double expected = 0.0;
    double slope = 0.0;
    for (int j = 0; j <= degree; ++j) {
      expected += (j + 1.0) * std::pow(p, j);
      if (j > 0) slope += j * (j + 1.0) * std::pow(p, j - 1);
    }
    const double t = (p - 0.4) / length;
    EXPECT_NEAR(interpolant(t)[0].real(), expected, 1e-12 * std::max(1.0, std::abs(expected)));
    EXPECT_NEAR(interpolant.slope(t)[0].real(), slope * length, 1e-11 * std::max(1.0, std::abs(slope)));
  }
  const Complex beside(0.3, 0.2);
  const Complex p = 0.4 + length * beside;
  Complex expected = 0.0;
  for (int j = 0; j <= degree; ++j) expected += (j + 1.0) * std::pow(p, j);
  EXPECT_LT(std::abs(interpolant(beside)[0] - expected), 1e-12 * std::abs(expected)) << "off the real axis";
}

TEST_P(DenseOutput, ErrorHasOrder2qPlus2) {
  const int q = GetParam();
  const auto error = [&](double h) {
    const HermiteInterpolant interpolant(h, exponential_series(0.0, q), exponential_series(h, q));
    return std::abs(interpolant(0.5)[0] - std::exp(Complex(0.3, 1.0) * h / 2.0));
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

/// The term that one order more would add, and the decay to it, stay within a small factor of the true error,
/// also on steps as long as the distance to the singularity, where an estimate from the previous step fails.
TEST_P(DenseOutputError, IsToldByTheDecayOfTheTerms) {
  const auto& [function, q] = GetParam();
  for (const double h : {0.1, 0.3, 1.0, 2.0}) {
    const HermiteInterpolant step(h, function.series(0.0, q), function.series(h, q));
    double error = 0.0;
    for (int i = 1; i < 100; ++i)
      error = std::max(error, std::abs(step(i / 100.0)[0] - function.exact(h * i / 100.0)));
    if (error < 1e-13) continue;
    const HermiteInterpolant one_more(h, function.series(0.0, q + 1), function.series(h, q + 1));
    const double estimate = one_more.error_without_last()[0];
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
    [](const auto& tested) {
      return std::get<0>(tested.param).name + "Order" + std::to_string(std::get<1>(tested.param));
    });

TEST(DenseOutputRival, MissOfThePreviousStepUnderestimatesNearASingularity) {
  const int q = 3;
  const auto series = [](double p, int order) { return root_series(2.2, p, order); };
  const HermiteInterpolant last(1.0, series(0.0, q), series(1.0, q));
  const HermiteInterpolant step(1.0, series(1.0, q), series(2.0, q));
  const double miss = std::abs(last(2.0)[0] - series(2.0, q)(0, 0)) * std::pow(0.25 / 2.0, q + 1);
  double error = 0.0;
  for (int i = 1; i < 100; ++i)
    error = std::max(error, std::abs(step(i / 100.0)[0] - series(1.0 + i / 100.0, q)(0, 0)));
  EXPECT_LT(miss, 0.1 * error);
  const HermiteInterpolant one_more(1.0, series(1.0, q + 1), series(2.0, q + 1));
  EXPECT_GT(one_more.error_without_last()[0], 0.4 * error);
}

/// (1 - t)^m exp(j t): series of order q about t.
ComplexMatrix vanishing_series(int m, double t, int q) {
  ComplexVector factor = ComplexVector::Zero(3);
  factor.head(m + 1) << (m == 1 ? ComplexVector{{1.0 - t, -1.0}}
                                : ComplexVector{{(1.0 - t) * (1.0 - t), -2.0 * (1.0 - t), 1.0}});
  ComplexMatrix product = ComplexMatrix::Zero(1, q + 1);
  Complex exponential = std::exp(Complex(0.0, t));
  for (int k = 0; k <= q; ++k) {
    for (int i = 0; i < 3 && i + k <= q; ++i) product(0, i + k) += factor[i] * exponential;
    exponential *= Complex(0.0, 1.0 / (k + 1));
  }
  return product;
}

TEST(DenseOutput, KeepsItsDigitsWhereAFunctionVanishesAtAnEnd) {
  // The error is rounding times the distance u from the end. Evaluated from the other end it would be of the
  // size of rounding itself.
  for (const int m : {1, 2}) {
    const HermiteInterpolant forward(1.0, vanishing_series(m, 0.0, 4), vanishing_series(m, 1.0, 4));
    for (const double u : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12}) {
      const double t = 1.0 - u;
      const Complex exact = std::pow(1.0 - t, m) * std::exp(Complex(0.0, t));
      EXPECT_LT(std::abs(forward(t)[0] - exact), 1e-14 * u + 0.1 * std::pow(u, 5))
          << "u = " << u << ", m = " << m;
    }
  }
}

}  // namespace
}  // namespace eigentrail::test::dense_output_test
