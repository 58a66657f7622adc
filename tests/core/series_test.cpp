#include "eigentrail/core/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace eigentrail::test::series_test {
namespace {

constexpr int order = 4;
using S = Series<double, order>;
using Coefficients = std::array<double, order + 1>;

// Some fifty roundings of terms that are at most a few hundred times the largest coefficient.
constexpr double rounding = 1e-13;

S series(const Coefficients& c) {
  S x;
  for (int k = 0; k <= order; ++k) x[k] = c[k];
  return x;
}

/// Largest difference of two series relative to the largest coefficient of the expected one.
double relative_difference(const S& x, const S& expected) {
  double difference = 0.0;
  double scale = 0.0;
  for (int k = 0; k <= order; ++k) {
    difference = std::max(difference, std::abs(x[k] - expected[k]));
    scale = std::max(scale, std::abs(expected[k]));
    if (std::isnan(x[k])) return std::numeric_limits<double>::infinity();
  }
  return difference / scale;
}

/// sum_k f^(k)(x_0) u^k / k! with u = x - x_0, the powers of u by convolution: Taylor's theorem.
S compose(const Coefficients& derivatives, const S& x) {
  Coefficients power = {1.0};
  S result;
  double factorial = 1.0;
  for (int k = 0; k <= order; ++k) {
    if (k > 0) factorial *= k;
    for (int i = 0; i <= order; ++i) result[i] += derivatives[k] / factorial * power[i];
    Coefficients next = {};
    for (int i = 0; i <= order; ++i) {
      for (int j = 1; i + j <= order; ++j) next[i + j] += power[i] * x[j];
    }
    power = next;
  }
  return result;
}

struct Function {
  std::string name;
  double x0;
  std::function<S(const S&)> on_series;
  std::function<Coefficients(double)> derivatives;  ///< f, f', f'', f''', f'''' in closed form
};

void PrintTo(const Function& function, std::ostream* out) {
  *out << function.name;
}

std::vector<Function> functions() {
  return {
      {"exp", 0.7, [](const S& x) { return exp(x); },
       [](double x) -> Coefficients {
         const double e = std::exp(x);
         return {e, e, e, e, e};
       }},
      {"log", 1.7, [](const S& x) { return log(x); },
       [](double x) -> Coefficients {
         return {std::log(x), 1 / x, -1 / (x * x), 2 / std::pow(x, 3), -6 / std::pow(x, 4)};
       }},
      {"sqrt", 2.3, [](const S& x) { return sqrt(x); },
       [](double x) -> Coefficients {
         const double r = std::sqrt(x);
         return {r, 0.5 / r, -0.25 / (r * x), 0.375 / (r * x * x), -0.9375 / (r * x * x * x)};
       }},
      {"sin", 0.9, [](const S& x) { return sin(x); },
       [](double x) -> Coefficients {
         const double s = std::sin(x), c = std::cos(x);
         return {s, c, -s, -c, s};
       }},
      {"cos", 0.9, [](const S& x) { return cos(x); },
       [](double x) -> Coefficients {
         const double s = std::sin(x), c = std::cos(x);
         return {c, -s, -c, s, c};
       }},
      {"tan", -0.6, [](const S& x) { return tan(x); },
       [](double x) -> Coefficients {
         const double t = std::tan(x), d = 1 + t * t;
         return {t, d, 2 * t * d, 2 * d * (1 + 3 * t * t), 8 * t * d * (2 + 3 * t * t)};
       }},
      {"sinh", 0.4, [](const S& x) { return sinh(x); },
       [](double x) -> Coefficients {
         const double s = std::sinh(x), c = std::cosh(x);
         return {s, c, s, c, s};
       }},
      {"cosh", -1.1, [](const S& x) { return cosh(x); },
       [](double x) -> Coefficients {
         const double s = std::sinh(x), c = std::cosh(x);
         return {c, s, c, s, c};
       }},
      {"tanh", 0.5, [](const S& x) { return tanh(x); },
       [](double x) -> Coefficients {
         const double t = std::tanh(x), d = 1 - t * t;
         return {t, d, -2 * t * d, -2 * d * (1 - 3 * t * t), 8 * t * d * (2 - 3 * t * t)};
       }},
      {"asin", 0.3, [](const S& x) { return asin(x); },
       [](double x) -> Coefficients {
         const double w = 1 - x * x;
         return {std::asin(x), std::pow(w, -0.5), x * std::pow(w, -1.5), (1 + 2 * x * x) * std::pow(w, -2.5),
                 (9 + 6 * x * x) * x * std::pow(w, -3.5)};
       }},
      {"acos", -0.4, [](const S& x) { return acos(x); },
       [](double x) -> Coefficients {
         const double w = 1 - x * x;
         return {std::acos(x), -std::pow(w, -0.5), -x * std::pow(w, -1.5),
                 -(1 + 2 * x * x) * std::pow(w, -2.5), -(9 + 6 * x * x) * x * std::pow(w, -3.5)};
       }},
      {"atan", 1.3, [](const S& x) { return atan(x); },
       [](double x) -> Coefficients {
         const double d = 1 + x * x;
         return {std::atan(x), 1 / d, -2 * x / (d * d), (6 * x * x - 2) / std::pow(d, 3),
                 24 * x * (1 - x * x) / std::pow(d, 4)};
       }},
      {"power_two_and_a_half", 1.9, [](const S& x) { return pow(x, S(2.5)); },
       [](double x) -> Coefficients {
         return {std::pow(x, 2.5), 2.5 * std::pow(x, 1.5), 3.75 * std::pow(x, 0.5), 1.875 * std::pow(x, -0.5),
                 -0.9375 * std::pow(x, -1.5)};
       }},
      {"two_to_the_power", 1.2, [](const S& x) { return pow(S(2.0), x); },
       [](double x) -> Coefficients {
         const double y = std::pow(2.0, x), l = std::log(2.0);
         return {y, l * y, l * l * y, l * l * l * y, l * l * l * l * y};
       }},
      {"seventh_power_of_a_negative_number", -1.2, [](const S& x) { return integer_power(x, 7); },
       [](double x) -> Coefficients {
         return {std::pow(x, 7), 7 * std::pow(x, 6), 42 * std::pow(x, 5), 210 * std::pow(x, 4),
                 840 * std::pow(x, 3)};
       }},
      {"minus_third_power_of_a_negative_number", -0.8, [](const S& x) { return integer_power(x, -3); },
       [](double x) -> Coefficients {
         return {std::pow(x, -3), -3 * std::pow(x, -4), 12 * std::pow(x, -5), -60 * std::pow(x, -6),
                 360 * std::pow(x, -7)};
       }},
      {"reciprocal", 0.7, [](const S& x) { return 1.0 / x; },
       [](double x) -> Coefficients {
         return {1 / x, -1 / (x * x), 2 / std::pow(x, 3), -6 / std::pow(x, 4), 24 / std::pow(x, 5)};
       }},
  };
}

class SeriesFunction : public testing::TestWithParam<Function> {};

TEST_P(SeriesFunction, HasTheTaylorCoefficientsOfTheClosedForm) {
  const Function& f = GetParam();
  const Coefficients derivatives = f.derivatives(f.x0);
  const std::vector<std::pair<std::string, S>> arguments = {
      {"x0", series({f.x0})},
      {"x0 + h", series({f.x0, 1.0})},
      {"x0 + 2h - h^2", series({f.x0, 2.0, -1.0})},
      {"x0 + h^2 (no linear term)", series({f.x0, 0.0, 1.0})},
      {"generic", series({f.x0, 0.7, -0.3, 0.2, 0.5})}};
  for (const auto& [text, x] : arguments) {
    EXPECT_LT(relative_difference(f.on_series(x), compose(derivatives, x)), rounding) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SeriesFunction, testing::ValuesIn(functions()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Series, BeatsCentralDifferencesOfTheFourthDerivativeAtTheirBestStep) {
  // For comparison, a five-point difference has a rounding error eps / step^4 and a truncation error step^2.
  constexpr double orders_of_magnitude = 1e6;
  const double x0 = 0.9;
  const double exact =
      std::exp(std::sin(x0)) * (std::pow(std::cos(x0), 4) - 6 * std::sin(x0) * std::pow(std::cos(x0), 2) +
                                3 * std::pow(std::sin(x0), 2) - 4 * std::pow(std::cos(x0), 2) + std::sin(x0));
  const auto f = [](double x) { return std::exp(std::sin(x)); };
  double best = std::numeric_limits<double>::infinity();
  for (double step = 1.0; step > 1e-6; step /= 1.25) {
    const double difference =
        f(x0 - 2 * step) - 4 * f(x0 - step) + 6 * f(x0) - 4 * f(x0 + step) + f(x0 + 2 * step);
    best = std::min(best, std::abs(difference / std::pow(step, 4) - exact));
  }
  const double error = std::abs(24.0 * exp(sin(series({x0, 1.0})))[4] - exact);
  EXPECT_LT(error, rounding * std::abs(exact));
  EXPECT_GT(best, orders_of_magnitude * std::max(error, std::numeric_limits<double>::epsilon()));
}

/// Series with a constant term between 0.2 and 0.8, inside the domain of every function here.
std::vector<S> generic_series(int count) {
  std::mt19937 generator(20240601);
  std::uniform_real_distribution<double> constant(0.2, 0.8), other(-1.0, 1.0);
  std::vector<S> list;
  for (int i = 0; i < count; ++i) {
    S x(constant(generator));
    for (int k = 1; k <= order; ++k) x[k] = other(generator);
    list.push_back(x);
  }
  return list;
}

TEST(Series, QuotientTimesDivisorGivesBackTheDividend) {
  const std::vector<S> x = generic_series(20);
  for (std::size_t i = 1; i < x.size(); ++i) {
    EXPECT_LT(relative_difference(x[i - 1] / x[i] * x[i], x[i - 1]), rounding);
  }
}

TEST(Series, PowerWithVaryingExponentIsTheExponentialOfItsLogarithm) {
  // d/dx x^x = x^x (1 + log x)
  const S x = series({1.4, 1.0});
  const S y = pow(x, x);
  const S rate = y * (1.0 + log(x));
  EXPECT_DOUBLE_EQ(y[0], std::pow(1.4, 1.4));
  for (int k = 1; k <= order; ++k) EXPECT_NEAR(k * y[k], rate[k - 1], rounding * std::abs(rate[0]));
}

TEST(Series, ShorterSeriesIsTheBeginningOfTheLongerOne) {
  using Short = Series<double, 2>;
  const auto f = [](auto x) { return sin(x) / sqrt(x) + exp(atan(x) - 0.5) * integer_power(x, -2); };
  const S x = series({0.6, 0.5, -0.2, 0.9, 0.1});
  Short s;
  for (int k = 0; k <= 2; ++k) s[k] = x[k];
  const S longer = f(x);
  const Short shorter = f(s);
  for (int k = 0; k <= 2; ++k) EXPECT_DOUBLE_EQ(shorter[k], longer[k]);
  EXPECT_DOUBLE_EQ(f(Series<double, 0>(0.6))[0], longer[0]);
}

TEST(Series, CompoundAssignmentsEqualTheirOperators) {
  const std::vector<S> x = generic_series(2);
  const auto applied = [&](const auto& assign) {
    S y = x[0];
    assign(y);
    return y;
  };
  EXPECT_EQ(relative_difference(applied([&](S& y) { y += x[1]; }), x[0] + x[1]), 0.0);
  EXPECT_EQ(relative_difference(applied([&](S& y) { y -= x[1]; }), x[0] - x[1]), 0.0);
  EXPECT_EQ(relative_difference(applied([&](S& y) { y *= x[1]; }), x[0] * x[1]), 0.0);
  EXPECT_EQ(relative_difference(applied([&](S& y) { y /= x[1]; }), x[0] / x[1]), 0.0);
  EXPECT_EQ(relative_difference(applied([&](S& y) { y *= 3.0; }), 3.0 * x[0]), 0.0);
  EXPECT_EQ(relative_difference(applied([&](S& y) { y *= y; }), x[0] * x[0]), 0.0);
}

TEST(Series, IntegerPowersOfASeriesThatBeginsAtZeroAreExact) {
  const S h = series({0.0, 1.0});
  for (int n = 0; n <= 6; ++n) {
    const S power = integer_power(h, n);
    for (int k = 0; k <= order; ++k) EXPECT_EQ(power[k], k == n ? 1.0 : 0.0) << "h^" << n;
  }
  // For comparison, the general power uses the logarithm.
  EXPECT_FALSE(std::isfinite(pow(h, S(2.5))[2]));
  EXPECT_FALSE(std::isfinite(integer_power(h, -1)[0]));
}

TEST(Series, SquareRootAndLogarithmAtZeroAreNotFinite) {
  for (const S& x : {series({0.0, 1.0}), series({0.0, 0.0, 1.0}), S(0.0)}) {
    EXPECT_FALSE(std::isfinite(sqrt(x)[1]));
    EXPECT_FALSE(std::isfinite(log(x)[0]));
    EXPECT_FALSE(std::isfinite(log(x)[1]));
  }
}

TEST(Series, FunctionsOutsideTheirDomainAreNotFinite) {
  EXPECT_FALSE(std::isfinite(sqrt(series({-1.0, 1.0}))[0]));
  EXPECT_FALSE(std::isfinite(log(series({-1.0, 1.0}))[0]));
  EXPECT_FALSE(std::isfinite(asin(series({1.0, 1.0}))[1]));
  EXPECT_FALSE(std::isfinite(acos(series({-1.0, 1.0}))[1]));
  EXPECT_FALSE(std::isfinite(pow(series({-1.0, 1.0}), S(0.5))[0]));
  EXPECT_FALSE(std::isfinite((S(1.0) / series({0.0, 1.0}))[0]));
}

TEST(Series, HyperbolicTangentSaturatesForLargeArguments) {
  // sinh and cosh overflow beyond 710; tanh(v / width) smooths a sign and meets such arguments.
  for (const double sign : {1.0, -1.0}) {
    const S y = tanh(series({800.0 * sign, 1.0, 0.5}));
    EXPECT_EQ(y[0], sign);
    for (int k = 1; k <= order; ++k) EXPECT_EQ(y[k], 0.0);
  }
}

}  // namespace
}  // namespace eigentrail::test::series_test
