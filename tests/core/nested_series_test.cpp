// Series of series: derivatives as series along the path, and series as the scalar of Eigen's matrices.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "eigentrail/core/series.hpp"

namespace eigentrail::test::nested_series_test {
namespace {

constexpr int order = 4;
using S = Series<double, order>;
using First = Series<S, 1>;       // value and one directional derivative
using Second = Series<First, 1>;  // and the derivative of that in another direction
using Vector3S = Eigen::Matrix<S, 3, 1>;

// Some hundred roundings of terms that are at most a hundred times the coefficients compared.
constexpr double rounding = 1e-13;

S series(std::initializer_list<double> coefficients) {
  S x;
  int k = 0;
  for (const double c : coefficients) x[k++] = c;
  return x;
}

void expect_near(const S& x, const S& expected, double tolerance = rounding) {
  for (int k = 0; k <= order; ++k) {
    EXPECT_NEAR(x[k], expected[k], tolerance * (1.0 + std::abs(expected[k]))) << "coefficient of h^" << k;
  }
}

/// x as a variable with derivative 1.
First seeded(const S& x) {
  First variable(x);
  variable[1] = S(1.0);
  return variable;
}

TEST(NestedSeries, KnowsTheDerivativeOfEveryFunction) {
  const S x = series({0.4, 0.7, -0.3, 0.2, 0.5});
  const First t = seeded(x);
  expect_near(exp(t)[1], exp(x));
  expect_near(log(t)[1], 1.0 / x, 1e-12);  // coefficients grow like 1 / x0^5 = 100
  expect_near(sqrt(t)[1], 0.5 / sqrt(x));
  expect_near(sin(t)[1], cos(x));
  expect_near(cos(t)[1], -sin(x));
  expect_near(tan(t)[1], 1.0 / (cos(x) * cos(x)));
  expect_near(sinh(t)[1], cosh(x));
  expect_near(cosh(t)[1], sinh(x));
  expect_near(tanh(t)[1], 1.0 / (cosh(x) * cosh(x)));
  expect_near(asin(t)[1], 1.0 / sqrt(1.0 - x * x));
  expect_near(acos(t)[1], -1.0 / sqrt(1.0 - x * x));
  expect_near(atan(t)[1], 1.0 / (1.0 + x * x));
  expect_near(integer_power(t, 5)[1], 5.0 * integer_power(x, 4));
  expect_near(integer_power(t, -2)[1], -2.0 * integer_power(x, -3), 1e-11);  // 1 / x0^7 = 600
  expect_near(pow(t, First(2.5))[1], 2.5 * pow(x, S(1.5)));
}

/// f(x, y) with x and y seeded in the outer and the inner direction, or the other way round.
template <class Function>
Second with_both_directions(const Function& f, const S& x, const S& y, bool x_outside) {
  First first_x(x), first_y(y);
  (x_outside ? first_y : first_x)[1] = S(1.0);
  Second second_x(first_x), second_y(first_y);
  (x_outside ? second_x : second_y)[1] = First(S(1.0));
  return f(second_x, second_y);
}

TEST(NestedSeries, MixedSecondDerivativesAreRightAndSymmetric) {
  const S x = series({0.9, 0.4, -0.2, 0.3});
  const S y = series({-1.3, 0.5, 0.6, 0.0, -0.2});
  const auto length = [](const auto& a, const auto& b) { return sqrt(a * a + b * b); };
  const auto wave = [](const auto& a, const auto& b) { return exp(a * b) * sin(a); };
  const S r = length(x, y);
  const S length_xy = -x * y / (r * r * r);
  const S wave_xy = exp(x * y) * (sin(x) + x * cos(x) + x * y * sin(x));

  expect_near(with_both_directions(length, x, y, true)[1][1], length_xy);
  expect_near(with_both_directions(length, x, y, false)[1][1], length_xy);
  expect_near(with_both_directions(wave, x, y, true)[1][1], wave_xy);
  expect_near(with_both_directions(wave, x, y, false)[1][1], wave_xy);
}

TEST(NestedSeries, KeepsTheTwoDirectionsApart) {
  const S x = series({0.9, 0.4, -0.2, 0.3});
  const S y = series({-1.3, 0.5, 0.6, 0.0, -0.2});
  const auto f = [](const auto& a, const auto& b) { return a * a * a * b * b; };
  const Second z = with_both_directions(f, x, y, true);
  expect_near(z[0][0], x * x * x * y * y);
  expect_near(z[1][0], 3.0 * x * x * y * y);
  expect_near(z[0][1], 2.0 * x * x * x * y);
  expect_near(z[1][1], 6.0 * x * x * y);
}

TEST(NestedSeries, SquareRootAtZeroIsNotFinite) {
  const First root = sqrt(seeded(S(0.0)));
  EXPECT_FALSE(std::isfinite(root[1][0]));
}

TEST(SeriesAsEigenScalar, NormOfAHelixHasItsClosedForm) {
  // |(a cos h, a sin h, b h)| = sqrt(a^2 + b^2 h^2) = a + b^2 h^2 / (2 a) - b^4 h^4 / (8 a^3)
  const double a = 1.5;
  const double b = 0.8;
  const S h = series({0.0, 1.0});
  const Vector3S r(a * cos(h), a * sin(h), b * h);
  const S expected = series({a, 0.0, b * b / (2 * a), 0.0, -std::pow(b, 4) / (8 * std::pow(a, 3))});
  expect_near(r.norm(), expected);
  expect_near(r.squaredNorm(), series({a * a, 0.0, b * b}));
  expect_near(r.dot(r), series({a * a, 0.0, b * b}));
}

TEST(SeriesAsEigenScalar, MixesWithNumbersAndNestedSeries) {
  const S h = series({0.0, 1.0});
  const Eigen::Vector3d numbers(1.0, -2.0, 0.5);
  const Vector3S u(S(1.0), h, h * h);
  const Vector3S sum = 2.0 * u + numbers.cast<S>() * h;
  expect_near(sum[0], series({2.0, 1.0}), 0.0);
  expect_near(sum[1], S(0.0), 0.0);
  expect_near(sum[2], series({0.0, 0.5, 2.0}), 0.0);

  using Vector2Second = Eigen::Matrix<Second, 2, 1>;
  const auto length = [](const Second& a, const Second& b) { return Vector2Second(a, b).norm(); };
  const S x = series({3.0, 1.0});
  const S y = series({4.0, -0.5});
  const S r = sqrt(x * x + y * y);
  expect_near(with_both_directions(length, x, y, true)[1][1], -x * y / (r * r * r));
}

}  // namespace
}  // namespace eigentrail::test::nested_series_test
