#include "eigentrail/core/chebyshev.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/spectra.hpp"

namespace eigentrail::test::chebyshev_test {
namespace {

std::vector<Complex> roots_near_unit_interval(const std::function<Complex(double)>& f, int degree) {
  return chebyshev_roots(chebyshev_coefficients(f, degree));
}

// Roots of unit size from coefficients of unit size, a few hundred roundings.
constexpr double tolerance = 1e-12;

/// The polynomial with these roots at t.
Complex polynomial(const std::vector<Complex>& roots, double t) {
  Complex value = 1.0;
  for (const Complex root : roots) value *= t - root;
  return value;
}

/// Distance from `root` to the nearest of `found`.
double distance(Complex root, const std::vector<Complex>& found) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Complex t : found) nearest = std::min(nearest, std::abs(t - root));
  return nearest;
}

struct RootsCase {
  std::string name;
  std::vector<Complex> roots;
};

class ChebyshevRoots : public testing::TestWithParam<RootsCase> {};

TEST_P(ChebyshevRoots, OfAPolynomialAreAllFound) {
  const std::vector<Complex>& roots = GetParam().roots;
  const auto f = [&](double t) { return polynomial(roots, t); };
  const auto found = roots_near_unit_interval(f, static_cast<int>(roots.size()));
  EXPECT_LT(matched_distance(roots, found), tolerance);
}

TEST_P(ChebyshevRoots, AreStillFoundWhenTheDegreeIsHigherThanNeeded) {
  const std::vector<Complex>& roots = GetParam().roots;
  const auto f = [&](double t) { return polynomial(roots, t); };
  const auto found = roots_near_unit_interval(f, static_cast<int>(roots.size()) + 4);
  for (const Complex root : roots) EXPECT_LT(distance(root, found), 100.0 * tolerance) << root;
}

INSTANTIATE_TEST_SUITE_P(Places, ChebyshevRoots,
                         testing::Values(RootsCase{"OneInside", {0.3}}, RootsCase{"AtTheEnds", {1e-3, 1.0}},
                                         RootsCase{"RealAndInside", {0.1, 0.25, 0.5, 0.77, 0.9}},
                                         RootsCase{
                                             "BesideTheInterval",
                                             {Complex(0.4, 0.1), Complex(0.4, -0.1), Complex(0.7, 1e-3)}},
                                         RootsCase{"NotConjugate", {Complex(0.2, 0.3), Complex(0.8, 0.1)}},
                                         RootsCase{"OneFarAway", {0.5, Complex(-3.0, 2.0)}}),
                         [](const auto& test) { return test.param.name; });

TEST(ChebyshevRoots, BesideTheAxisStayThereWhenHighCoefficientsAreRounding) {
  // What an interpolant of a parabola may look like: dividing by its leading coefficient would make its two
  // roots real.
  const Complex root(0.78, 3.2e-3);
  ComplexVector coefficients = chebyshev_coefficients(
      [&](double t) {
        return polynomial({root, std::conj(root)}, t);
      },
      9);
  for (const double noise : {1e-14, 1e-13, 2e-13, 1e-12}) {
    coefficients.tail(7).setConstant(noise * coefficients.cwiseAbs().maxCoeff());
    EXPECT_LT(distance(root, chebyshev_roots(coefficients)), 1e-7) << noise;
  }
}

TEST(ChebyshevRoots, OfASmoothFunctionConvergeWithTheDegree) {
  // cos(9 t) vanishes at pi/18, pi/6, 5 pi/18.
  const auto error = [](int degree) {
    const auto found = roots_near_unit_interval([](double t) { return Complex(std::cos(9.0 * t)); }, degree);
    double worst = 0.0;
    for (const double k : {1.0, 3.0, 5.0})
      worst = std::max(worst, distance(k * std::numbers::pi / 18.0, found));
    return worst;
  };
  EXPECT_GT(error(8), 1e-6);
  EXPECT_LT(error(16), 1e-8);
  EXPECT_LT(error(24), tolerance);
}

TEST(ChebyshevRoots, DoubleOnesKeepHalfTheDigits) {
  const auto found = roots_near_unit_interval([](double t) { return Complex((t - 0.6) * (t - 0.6)); }, 9);
  int near = 0;
  for (const Complex t : found) near += std::abs(t - 0.6) < 1e-6 ? 1 : 0;
  EXPECT_EQ(near, 2);
}

TEST(ChebyshevRoots, DoNotDependOnTheSizeOfTheFunction) {
  const std::vector<Complex> roots{0.2, Complex(0.5, 0.05), 0.8};
  for (const double size : {1e-200, 1e-12, 1e200}) {
    const auto f = [&](double t) { return size * polynomial(roots, t); };
    EXPECT_LT(matched_distance(roots, roots_near_unit_interval(f, 3)), tolerance) << "size " << size;
  }
}

TEST(ChebyshevRoots, OfAConstantOrNothingAreNone) {
  EXPECT_TRUE(roots_near_unit_interval([](double) { return Complex(0.0); }, 6).empty());
  EXPECT_TRUE(roots_near_unit_interval([](double) { return Complex(0.3, -2.0); }, 6).empty());
}

TEST(ChebyshevRoots, OfWhatIsNotFiniteAreNone) {
  const auto f = [](double t) { return Complex(t > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1.0); };
  EXPECT_TRUE(roots_near_unit_interval(f, 6).empty());
}

/// Coefficients of the polynomial with these roots, lowest power first.
ComplexVector coefficients(const std::vector<Complex>& roots) {
  ComplexVector c = ComplexVector::Ones(1);
  for (const Complex root : roots) {
    ComplexVector next = ComplexVector::Zero(c.size() + 1);
    next.tail(c.size()) += c;
    next.head(c.size()) -= root * c;
    c = next;
  }
  return c;
}

TEST(PolynomialRoots, AreAllFound) {
  const std::vector<Complex> roots{Complex(0.5, 2.0), -1.0, Complex(0.3, -0.4), 2.0, 1e-3};
  EXPECT_LT(matched_distance(roots, polynomial_roots(coefficients(roots))), 100.0 * tolerance);
  EXPECT_LT(matched_distance(roots, polynomial_roots(1e100 * coefficients(roots))), 100.0 * tolerance);
}

TEST(PolynomialRoots, LeadingZerosLowerTheDegree) {
  ComplexVector c = ComplexVector::Zero(6);
  c.head(3) = coefficients({Complex(2.0), Complex(0.0, 3.0)});
  EXPECT_LT(matched_distance({Complex(2.0), Complex(0.0, 3.0)}, polynomial_roots(c)), tolerance);
  // One that rounding leaves adds roots far away, and moves none.
  c[4] = 1e-18;
  std::vector<Complex> near = polynomial_roots(c);
  std::erase_if(near, [](Complex root) { return std::abs(root) > 1e8; });
  EXPECT_LT(matched_distance({Complex(2.0), Complex(0.0, 3.0)}, near), tolerance);
}

TEST(PolynomialRoots, DoNotDependOnTheUnit) {
  for (const double unit : {1e-12, 1e-6, 1e9}) {
    const std::vector<Complex> roots{Complex(0.5, 2.0), -1.0, Complex(0.3, -0.4), 2.0, 30.0, 1e3};
    std::vector<Complex> in_unit;
    for (const Complex root : roots) in_unit.push_back(unit * root);
    std::vector<Complex> found = polynomial_roots(coefficients(in_unit));
    for (Complex& root : found) root /= unit;
    EXPECT_LT(matched_distance(roots, found), 1e3 * 100.0 * tolerance) << unit;
  }
}

TEST(PolynomialRoots, OfVeryDifferentSizeAreAllAccurate) {
  const std::vector<Complex> roots = polynomial_roots(coefficients({Complex(1e-14), -1e-3, 2e-3, 1.0, 1e3}));
  for (const double root : {1e-14, -1e-3, 2e-3, 1.0, 1e3}) {
    const auto nearest = std::min_element(roots.begin(), roots.end(), [&](Complex a, Complex b) {
      return std::abs(a - root) < std::abs(b - root);
    });
    ASSERT_NE(nearest, roots.end());
    EXPECT_LT(std::abs(*nearest / root - 1.0), 1e-6) << root;
  }
}

TEST(PolynomialRoots, OfZeroAreExact) {
  EXPECT_LT(matched_distance({Complex(0.0), Complex(0.0), Complex(-2.0)},
                             polynomial_roots(ComplexVector{{0.0, 0.0, 2.0, 1.0}})),
            tolerance);
}

TEST(PolynomialRoots, OfAConstantOrNothingAreNone) {
  EXPECT_TRUE(polynomial_roots(ComplexVector::Zero(4)).empty());
  EXPECT_TRUE(polynomial_roots(ComplexVector::Ones(1)).empty());
  EXPECT_TRUE(polynomial_roots(ComplexVector{{1.0, std::numeric_limits<double>::quiet_NaN()}}).empty());
}

TEST(HasNoRootWithin, TellsTheRadiusOfALinearPolynomial) {
  const ComplexVector c = coefficients({Complex(0.0, 2.0)});
  EXPECT_TRUE(has_no_root_within(c, 1.9));
  EXPECT_FALSE(has_no_root_within(c, 2.1));
}

/// Whether the root lies in the rectangle.
bool is_inside(Complex root, const Rectangle& rectangle) {
  const Complex offset = root - rectangle.center;
  return std::abs(offset.real()) <= rectangle.half_width && std::abs(offset.imag()) <= rectangle.half_height;
}

TEST(HasNoRootIn, SeesPastRootsBesideALongRectangle) {
  const Rectangle step{0.5, 0.5, 0.1};
  const std::vector<Complex> roots{Complex(0.5, 0.3), Complex(0.2, -0.4), Complex(-0.3, 0.05)};
  EXPECT_TRUE(has_no_root_in(coefficients(roots), step));
  EXPECT_FALSE(has_no_root_within(coefficients(roots), 1.0)) << "one disc does not tell";
}

TEST(HasNoRootIn, NeverLeavesOutARoot) {
  const Rectangle step{0.5, 0.6, 0.2};
  int left_out = 0;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const Complex root(-0.5 + 0.1 * i, -0.5 + 0.05 * j);
      const std::vector<Complex> roots{root, Complex(1.4, 0.4), Complex(-0.6, -0.3), Complex(0.1, 2.0)};
      const auto f = [&](double t) { return polynomial(roots, t); };
      const bool by_powers = has_no_root_in(coefficients(roots), step);
      const bool by_chebyshev = chebyshev_has_no_root_in(chebyshev_coefficients(f, 9), step);
      EXPECT_EQ(by_powers, by_chebyshev) << root;
      EXPECT_FALSE(by_powers && is_inside(root, step)) << root;
      left_out += by_powers;
    }
  }
  EXPECT_GT(left_out, 200) << "of 441, 324 of them outside";
}

TEST(HasNoRootIn, TellsNothingOfWhatVanishesOrIsNotFinite) {
  const Rectangle step{0.5, 0.5, 0.1};
  EXPECT_FALSE(has_no_root_in(ComplexVector::Zero(4), step));
  EXPECT_FALSE(has_no_root_in(ComplexVector{{std::numeric_limits<double>::quiet_NaN(), 1.0}}, step));
}

}  // namespace
}  // namespace eigentrail::test::chebyshev_test
