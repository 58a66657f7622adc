// Hermite interpolation at complex places: exact for polynomials, of known error for others, with roots
// beside the real axis.
#include "continuation/events/complex_interpolant.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test {
namespace {

constexpr double rounding = 1e-13;
constexpr Complex j{0.0, 1.0};
constexpr double trusted = 0.02;  ///< share as of veerings

/// Taylor coefficients at x of the polynomial sum_k c_k x^k.
ComplexVector taylor(const ComplexVector& c, double x, Eigen::Index count) {
  ComplexVector series = ComplexVector::Zero(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = k; i < c.size(); ++i) {
      double binomial = 1.0;
      for (Eigen::Index b = 0; b < k; ++b)
        binomial *= static_cast<double>(i - b) / static_cast<double>(b + 1);
      series[k] += binomial * c[i] * std::pow(x, static_cast<double>(i - k));
    }
  }
  return series;
}

Complex value_of(const ComplexVector& c, Complex x) {
  Complex value = 0.0;
  for (Eigen::Index i = c.size(); i-- > 0;) value = value * x + c[i];
  return value;
}

TEST(ComplexInterpolant, IsExactForPolynomialsOfItsDegree) {
  const ComplexVector c{{1.0, -2.0 + j, 0.5, 3.0 * j, -1.0, 0.7}};
  ComplexInterpolant f;
  f.add(-0.4, taylor(c, -0.4, 3));
  f.add(0.6, taylor(c, 0.6, 3));
  for (const Complex x : {Complex(0.1), Complex(0.1, 0.5), Complex(-0.7, -0.3)})
    EXPECT_LT(std::abs(f(x) - value_of(c, x)), rounding);
}

/// Points may be added at either side and between, in any order.
TEST(ComplexInterpolant, DoesNotDependOnTheOrderOfItsPoints) {
  const ComplexVector c{{1.0, -2.0 + j, 0.5, 3.0 * j, -1.0, 0.7}};
  ComplexInterpolant f;
  ComplexInterpolant g;
  for (const double x : {-0.4, 0.6, 0.1}) f.add(x, taylor(c, x, 2));
  for (const double x : {0.1, -0.4, 0.6}) g.add(x, taylor(c, x, 2));
  EXPECT_LT(std::abs(f(0.3 + 0.2 * j) - g(0.3 + 0.2 * j)), rounding);
}

/// exp at two points a distance h apart, with q coefficients each: error of the order h^(2q).
TEST(ComplexInterpolant, HasTheOrderOfAllItsCoefficients) {
  for (const Eigen::Index q : {1, 2, 3}) {
    const auto miss = [q](double h) {
      ComplexInterpolant f;
      for (const double x : {0.0, h}) {
        ComplexVector series(q);
        double factorial = 1.0;
        for (Eigen::Index k = 0; k < q; ++k) {
          series[k] = std::exp(x) / factorial;
          factorial *= static_cast<double>(k + 1);
        }
        f.add(x, series);
      }
      const Complex place = h * Complex(0.5, 0.3);
      const double error = std::abs(f(place) - std::exp(place));
      // The last terms are larger than the first one left out.
      EXPECT_LT(error, f.last_contribution(place));
      return error;
    };
    EXPECT_NEAR(std::log2(miss(0.4) / miss(0.2)), 2.0 * static_cast<double>(q), 0.4) << q;
  }
}

TEST(LastContribution, IsTheLargerOfTheLastTwoTerms) {
  // 1 + 2 x + 3 x^2 from one point: terms 2 |x| and 3 |x|^2.
  ComplexInterpolant f;
  f.add(0.0, ComplexVector{{1.0, 2.0, 3.0}});
  EXPECT_NEAR(f.last_contribution(0.1 * j), 0.2, rounding);
  EXPECT_NEAR(f.last_contribution(2.0 * j), 12.0, rounding);
  EXPECT_EQ(f.last_contribution(0.0), 0.0);
}

/// x^2 + w^2: the discriminant of a veering of half-width w at x = 0.
ComplexInterpolant veering(double w) {
  ComplexInterpolant f;
  const ComplexVector c{{w * w, 0.0, 1.0}};
  f.add(-0.3, taylor(c, -0.3, 2));
  f.add(0.5, taylor(c, 0.5, 2));
  return f;
}

TEST(RootNear, FindsTheRootBesideTheAxis) {
  for (const double w : {0.1, 1e-3, 1e-5}) {
    const Complex root = veering(w).root_near(0.2 * w + 1.3 * w * j, w);
    // Rounding of the value over the slope 2 w.
    EXPECT_LT(std::abs(root - w * j), 1e-15 / w + 1e-13 * w) << w;
  }
}

TEST(RootNear, StaysWhereTheFunctionIsConstant) {
  ComplexInterpolant f;
  f.add(0.0, ComplexVector{{1.0}});
  EXPECT_EQ(f.root_near(0.3 + 0.1 * j, 1.0), 0.3 + 0.1 * j);
  EXPECT_EQ(f.error_of_root(0.3, 0.1), INFINITY);
}

TEST(ErrorOfRoot, BoundsTheErrorMade) {
  // cos(x) - 1.1 has the roots +- j acosh(1.1).
  const Complex exact(0.0, std::acosh(1.1));
  const auto cosine = [](double h, Eigen::Index q) {
    ComplexInterpolant f;
    for (const double x : {-h, h}) {
      const ComplexVector all{
          {std::cos(x) - 1.1, -std::sin(x), -0.5 * std::cos(x), std::sin(x) / 6.0, std::cos(x) / 24.0}};
      f.add(x, all.head(q));
    }
    return f;
  };
  double last = INFINITY;
  for (const Eigen::Index q : {2, 3, 4, 5}) {
    const ComplexInterpolant f = cosine(0.5, q);
    const Complex root = f.root_near(0.4 * j, 0.4);
    const double made = std::abs(root - exact);
    EXPECT_LT(made, f.error_of_root(root, 1e-3)) << q;
    EXPECT_LT(made, 0.2 * last) << q;
    last = made;
  }
}

/// (x - a)^2 (x - a*)^2: two uncoupled modes that coincide at complex parameters.
TEST(IsDoubleRoot, TellsACrossingFromAnExceptionalPoint) {
  for (const double w : {0.2, 1e-2}) {
    const ComplexVector twice{{w * w * w * w, 0.0, 2.0 * w * w, 0.0, 1.0}};
    ComplexInterpolant f;
    for (const double x : {-w, 0.0, w}) f.add(x, taylor(twice, x, 3));
    EXPECT_TRUE(f.is_double_root(w * j, trusted)) << w;
    EXPECT_FALSE(veering(w).is_double_root(w * j, trusted)) << w;
  }
}

/// Two exceptional points d apart: one double root from afar, two from near by.
TEST(IsDoubleRoot, TakesTwoRootsForOneOnlyIfTheyAreMuchCloserThanTheAxis) {
  const auto two = [](double d) {
    // (x^2 + w1^2)(x^2 + w2^2) with w = 0.2 -+ d / 2.
    const double a = std::pow(0.2 - 0.5 * d, 2);
    const double b = std::pow(0.2 + 0.5 * d, 2);
    ComplexInterpolant f;
    for (const double x : {-0.2, 0.0, 0.2})
      f.add(x, taylor(ComplexVector{{a * b, 0.0, a + b, 0.0, 1.0}}, x, 3));
    return f.is_double_root(Complex(0.0, 0.2 - 0.5 * d), trusted);
  };
  EXPECT_TRUE(two(1e-3));
  EXPECT_FALSE(two(0.05));
}

}  // namespace
}  // namespace eigentrail::test
