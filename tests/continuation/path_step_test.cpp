#include "eigentrail/continuation/path_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "support/spectra.hpp"

namespace eigentrail::test::path_step_test {
namespace {

constexpr double tolerance = 1e-12;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Taylor coefficients of a polynomial (coefficients lowest power first) about t.
ComplexVector taylor(const ComplexVector& polynomial, double t, Eigen::Index count) {
  ComplexVector series = ComplexVector::Zero(count);
  ComplexVector derivative = polynomial;
  double factorial = 1.0;
  for (Eigen::Index k = 0; k < count && derivative.size() > 0; ++k) {
    Complex value = 0.0;
    for (Eigen::Index i = derivative.size() - 1; i >= 0; --i) value = value * t + derivative[i];
    series[k] = value / factorial;
    factorial *= static_cast<double>(k) + 1.0;
    ComplexVector next(derivative.size() - 1);
    for (Eigen::Index i = 0; i < next.size(); ++i) next[i] = static_cast<double>(i + 1) * derivative[i + 1];
    derivative = next;
  }
  return series;
}

/// A block whose functions are polynomials in t, on a step of length one.
DenseBlock block_of(const std::vector<ComplexVector>& polynomials, const std::vector<int>& modes) {
  constexpr Eigen::Index count = 4;
  DenseBlock block;
  block.modes = modes;
  block.left.resize(static_cast<Eigen::Index>(polynomials.size()), count);
  block.right = block.left;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    block.left.row(static_cast<Eigen::Index>(i)) = taylor(polynomials[i], 0.0, count).transpose();
    block.right.row(static_cast<Eigen::Index>(i)) = taylor(polynomials[i], 1.0, count).transpose();
  }
  return block;
}

const ComplexVector zero{{Complex(0.0)}};

TEST(FollowRoots, OfOneEvaluatesTheFunction) {
  const DenseBlock block = block_of({ComplexVector{{Complex(0.0, 2.0), 0.3, Complex(0.0, 1.0)}}}, {0});
  for (const double t : {0.0, 0.2, 1.0}) {
    const ComplexVector found = follow_roots(block, 1.0, ComplexVector(), 0.0, t);
    EXPECT_LT(std::abs(found[0] - Complex(0.3 * t, 2.0 + t * t)), tolerance);
  }
}

TEST(FollowRoots, ToNowhereAreNoNumbers) {
  const DenseBlock block = block_of({zero, ComplexVector{{1.0, 0.5}}}, {0, 1});
  bool told_apart = true;
  const ComplexVector found = follow_roots(block, 1.0, ComplexVector{{1.0, -1.0}}, 0.0, nan, &told_apart);
  EXPECT_TRUE(std::isnan(found[0].real()) && std::isnan(found[1].real()));
  EXPECT_FALSE(told_apart);
}

class FollowThroughVeering : public testing::TestWithParam<double> {};

TEST_P(FollowThroughVeering, KeepsTheUpperOneAbove) {
  // delta = (t - 0.4)^2 + eps^2: the roots come as close as 2 eps and part again.
  const double eps = GetParam();
  const DenseBlock block = block_of({zero, ComplexVector{{0.16 + eps * eps, -0.8, 1.0}}}, {0, 1});
  const ComplexVector start{{Complex(std::hypot(0.4, eps)), Complex(-std::hypot(0.4, eps))}};
  for (const double t : {0.1, 0.4, 0.7, 1.0}) {
    const ComplexVector found = follow_roots(block, 1.0, start, 0.0, t);
    EXPECT_GT(found[0].real(), 0.0) << "t = " << t;
    EXPECT_NEAR(std::abs(found[0]), std::hypot(t - 0.4, eps), 1e-8) << "t = " << t;
  }
  const ComplexVector end{{Complex(std::hypot(0.6, eps)), Complex(-std::hypot(0.6, eps))}};
  EXPECT_GT(follow_roots(block, 1.0, end, 1.0, 0.0)[0].real(), 0.0) << "backwards";
}

INSTANTIATE_TEST_SUITE_P(Widths, FollowThroughVeering, testing::Values(0.3, 1e-2, 1e-4, 1e-6));

/// delta runs three quarters of the way around zero while t runs from 0 to 1, so its roots turn by 135
/// degrees. Each is then nearer to where the other one was: values at both ends do not tell.
TEST(FollowRoots, TurnBeyondARightAngle) {
  DenseBlock block;
  block.modes = {0, 1};
  block.left = block.right = ComplexMatrix::Zero(2, 4);
  const Complex rate(0.0, 1.5 * std::numbers::pi);
  Complex term = 1.0;
  for (Eigen::Index k = 0; k < 4; ++k) {
    block.left(1, k) = term;
    block.right(1, k) = term * std::exp(rate);
    term *= rate / (static_cast<double>(k) + 1.0);
  }
  const ComplexVector start{{Complex(1.0), Complex(-1.0)}};
  const ComplexVector found = follow_roots(block, 1.0, start, 0.0, 1.0);
  EXPECT_LT(std::abs(found[0] - std::exp(0.5 * rate)), tolerance);
  EXPECT_LT(std::abs(found[1] + std::exp(0.5 * rate)), tolerance);
}

class FollowPastEachOther : public testing::TestWithParam<double> {};

/// delta = (t - 1/2 - j d)^2: the roots +-(t - 1/2 - j d) pass each other at the distance 2 d, as two modes
/// of different damping do whose frequencies cross. delta turns almost once around zero.
TEST_P(FollowPastEachOther, GoesStraightOn) {
  const Complex middle(0.5, GetParam());
  const DenseBlock block = block_of({zero, ComplexVector{{middle * middle, -2.0 * middle, 1.0}}}, {0, 1});
  const ComplexVector start{{-middle, middle}};
  for (const double t : {0.1, 0.6, 0.9, 1.0}) {
    const ComplexVector found = follow_roots(block, 1.0, start, 0.0, t);
    EXPECT_LT(std::abs(found[0] - (t - middle)), 1e-8) << "t = " << t;
    EXPECT_LT(std::abs(found[1] + (t - middle)), 1e-8) << "t = " << t;
  }
  const ComplexVector end{{1.0 - middle, middle - 1.0}};
  EXPECT_LT(std::abs(follow_roots(block, 1.0, end, 1.0, 0.0)[0] + middle), 1e-8) << "backwards";
}

INSTANTIATE_TEST_SUITE_P(Distances, FollowPastEachOther, testing::Values(0.3, 0.1, 0.03, 1e-2, 1e-3));

TEST(FollowRoots, OfThreeAreFollowedOneByOne) {
  // Lambda = diag(t, 1 - t, j (t - 1/2)) in a constant basis: the first two pass each other at a distance of
  // the third, which is what separates them from it; a small coupling keeps them apart.
  const double eps = 1e-3;
  const std::vector<ComplexVector> entries{ComplexVector{{0.0, 1.0}},
                                           ComplexVector{{Complex(eps)}},
                                           zero,
                                           ComplexVector{{Complex(eps)}},
                                           ComplexVector{{1.0, -1.0}},
                                           zero,
                                           zero,
                                           zero,
                                           ComplexVector{{Complex(3.0, -0.5), Complex(0.0, 1.0)}}};
  const DenseBlock block = block_of(entries, {0, 1, 2});
  const double apart = std::hypot(0.5, eps);
  const ComplexVector start{{Complex(0.5 - apart), Complex(0.5 + apart), Complex(3.0, -0.5)}};
  const ComplexVector found = follow_roots(block, 1.0, start, 0.0, 1.0);
  EXPECT_LT((found - ComplexVector{{Complex(0.5 - apart), Complex(0.5 + apart), Complex(3.0, 0.5)}}).norm(),
            1e-10);
}

/// A step with p itself as coordinate from 2 to 3, and blocks as polynomials in t.
PathStep straight_step(std::vector<DenseBlock> blocks) {
  PathStep step;
  step.length = 1.0;
  step.parameter = Matrix{{2.0, 1.0, 0.0, 0.0}, {3.0, 1.0, 0.0, 0.0}};
  step.blocks = std::move(blocks);
  return step;
}

TEST(StepEigenvalues, FollowTheModesOfTheEndsAndLeaveOutThoseThatDoNotExist) {
  // Modes 2 and 0 as a block, mode 3 alone; mode 1 does not exist. Mode 3 is stored below the axis.
  const DenseBlock pair =
      block_of({ComplexVector{{Complex(0.0, 2.0)}}, ComplexVector{{-0.04, -0.05}}}, {0, 2});
  const DenseBlock alone = block_of({ComplexVector{{Complex(-0.1, -5.0), 0.2}}}, {3});
  const PathStep step = straight_step({pair, alone});
  ComplexVector left(4), right(4);
  left << Complex(0.0, 1.8), Complex(nan, nan), Complex(0.0, 2.2), Complex(-0.1, 5.0);
  right << Complex(0.0, 1.7), Complex(nan, nan), Complex(0.0, 2.3), Complex(0.1, 5.0);
  for (const double t : {0.0, 0.25, 0.9, 1.0}) {
    const ComplexVector s = step_eigenvalues(step, left, right, t);
    const double root = std::sqrt(0.04 + 0.05 * t);
    EXPECT_LT(std::abs(s[0] - Complex(0.0, 2.0 - root)), tolerance) << "t = " << t;
    EXPECT_TRUE(std::isnan(s[1].real()));
    EXPECT_LT(std::abs(s[2] - Complex(0.0, 2.0 + root)), tolerance) << "t = " << t;
    EXPECT_LT(std::abs(s[3] - Complex(-0.1 + 0.2 * t, 5.0)), tolerance) << "t = " << t;
  }
}

TEST(StepEigenvalues, ThatMeetAtAnEndAreToldApartFromTheOther) {
  // An exceptional point at t = 0, then one at t = 1.
  for (const bool at_left : {true, false}) {
    const ComplexVector delta = at_left ? ComplexVector{{0.0, -0.09}} : ComplexVector{{-0.09, 0.09}};
    const PathStep step = straight_step({block_of({ComplexVector{{Complex(0.0, 2.0)}}, delta}, {1, 0})});
    const ComplexVector met{{Complex(0.0, 2.0), Complex(0.0, 2.0)}};
    const ComplexVector apart{{Complex(0.0, 2.3), Complex(0.0, 1.7)}};
    const ComplexVector s = step_eigenvalues(step, at_left ? met : apart, at_left ? apart : met, 0.25);
    const double root = 0.3 * std::sqrt(at_left ? 0.25 : 0.75);
    EXPECT_LT(std::abs(s[0] - Complex(0.0, 2.0 + root)), tolerance);
    EXPECT_LT(std::abs(s[1] - Complex(0.0, 2.0 - root)), tolerance);
  }
}

TEST(StepEigenvalues, ThatMeetZerosAtAnEndAreToldApartFromTheOther) {
  // Two zeros throughout, and s^2 = -t: at t = 0 all four are zero, and the zeros coincide at both ends.
  std::vector<ComplexVector> entries(16, zero);
  entries[2 + 4 * 3] = ComplexVector{{1.0}};
  entries[3 + 4 * 2] = ComplexVector{{0.0, -1.0}};
  const PathStep step = straight_step({block_of(entries, {1, 0})});
  const ComplexVector left{{0.0, 0.0}}, right{{Complex(0.0, 1.0), 0.0}};
  for (const double t : {0.04, 0.25, 0.81}) {
    const ComplexVector s = step_eigenvalues(step, left, right, t);
    EXPECT_LT(std::abs(s[0] - Complex(0.0, std::sqrt(t))), tolerance) << "t = " << t;
    EXPECT_LT(std::abs(s[1]), tolerance) << "t = " << t;
  }
}

TEST(StepEigenvalues, RealBlockTellsAPairByItsUpperMember) {
  // delta < 0: a pair; its lower member is no mode.
  const PathStep step = straight_step({block_of({ComplexVector{{-0.2}}, ComplexVector{{-1.0, 0.5}}}, {0})});
  const ComplexVector left{{Complex(-0.2, 1.0)}};
  const ComplexVector right{{Complex(-0.2, std::sqrt(0.5))}};
  const ComplexVector s = step_eigenvalues(step, left, right, 0.5);
  EXPECT_LT(std::abs(s[0] - Complex(-0.2, std::sqrt(0.75))), tolerance);
}

TEST(StepEigenvalues, PassThroughInfinityInTheReciprocalChart) {
  // mu = t - 1/2.
  DenseBlock block = block_of({ComplexVector{{-0.5, 1.0}}}, {0});
  block.chart = Chart::reciprocal;
  const PathStep step = straight_step({block});
  const ComplexVector left{{Complex(-2.0)}};
  const ComplexVector right{{Complex(2.0)}};
  EXPECT_NEAR(step_eigenvalues(step, left, right, 0.25)[0].real(), -4.0, tolerance);
  EXPECT_NEAR(step_eigenvalues(step, left, right, 0.9)[0].real(), 2.5, tolerance);
  EXPECT_TRUE(std::isinf(step_eigenvalues(step, left, right, 0.5)[0].real()));
}

TEST(StepPositions, AreUniqueWhereThePathsCoordinateIsTheParameter) {
  const PathStep step = straight_step({});
  EXPECT_EQ(step_positions(step, 2.0), std::vector<double>{0.0});
  EXPECT_EQ(step_positions(step, 2.25), std::vector<double>{0.25});
  EXPECT_EQ(step_positions(step, 3.0), std::vector<double>{1.0});
  EXPECT_TRUE(step_positions(step, 1.999).empty());
  EXPECT_TRUE(step_positions(step, 3.001).empty());
  PathStep down = step;
  down.length = -1.0;
  down.parameter = Matrix{{3.0, 1.0, 0.0, 0.0}, {2.0, 1.0, 0.0, 0.0}};
  EXPECT_EQ(step_positions(down, 2.25), std::vector<double>{0.75});
}

/// A step of any path p(sigma): series of a polynomial in t at both ends, in the coordinate sigma = length t.
PathStep curved_step(const ComplexVector& polynomial, double length, Eigen::Index count) {
  PathStep step;
  step.length = length;
  step.parameter.resize(2, count);
  step.parameter.row(0) = taylor(polynomial, 0.0, count).real().transpose();
  step.parameter.row(1) = taylor(polynomial, 1.0, count).real().transpose();
  for (Eigen::Index k = 0; k < count; ++k) step.parameter.col(k) /= std::pow(length, static_cast<double>(k));
  return step;
}

class FoldedStep : public testing::TestWithParam<Eigen::Index> {};

/// p = 2 - (t - 0.4)^2: the path turns back at p = 2.
TEST_P(FoldedStep, PassesAParameterTwiceBeforeTheFoldOnceAtItAndNeverBehind) {
  const ComplexVector p{{2.0 - 0.16, 0.8, -1.0}};
  const PathStep step = curved_step(p, 0.3, GetParam());
  for (const double depth : {0.15, 0.1, 1e-2, 1e-4}) {
    const std::vector<double> found = step_positions(step, 2.0 - depth);
    ASSERT_EQ(found.size(), 2U) << "depth " << depth;
    // A root of p(t) = p is told to rounding over the slope there.
    const double accuracy = 1e-13 / std::sqrt(depth);
    EXPECT_NEAR(found[0], 0.4 - std::sqrt(depth), accuracy) << "depth " << depth;
    EXPECT_NEAR(found[1], 0.4 + std::sqrt(depth), accuracy) << "depth " << depth;
  }
  const std::vector<double> once = step_positions(step, 2.0 - 0.25);
  ASSERT_EQ(once.size(), 1U);
  EXPECT_NEAR(once[0], 0.9, 1e-12);
  EXPECT_TRUE(step_positions(step, 2.0 + 1e-6).empty());
  EXPECT_TRUE(step_positions(step, 1.6).empty());
  // Both ends belong to the step.
  EXPECT_EQ(step_positions(step, 2.0 - 0.16).size(), 2U);
  const std::vector<double> last = step_positions(step, 2.0 - 0.36);
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0], 1.0);
}

INSTANTIATE_TEST_SUITE_P(SeriesLengths, FoldedStep, testing::Values(2, 3, 4, 5));

/// p = cos(sigma), on a step that begins or ends at the fold. The distance of a position from the fold has
/// full relative accuracy, although p there differs from its extremum only in the last digits.
TEST(StepPositions, BesideAFoldAtAnEndAreRelativelyAccurate) {
  constexpr double length = 0.3;
  const auto series = [](double at) {
    Eigen::RowVectorXd c(5);
    c << std::cos(at), -std::sin(at), -std::cos(at) / 2.0, std::sin(at) / 6.0, std::cos(at) / 24.0;
    return c;
  };
  for (const double depth : {1e-4, 1e-8, 1e-12, 1e-15}) {
    const double p = 1.0 - depth;
    const double sigma = 2.0 * std::asin(std::sqrt((1.0 - p) / 2.0));
    PathStep step;
    step.length = length;
    step.parameter.resize(2, 5);
    step.parameter << series(0.0), series(length);
    std::vector<double> found = step_positions(step, p);
    ASSERT_EQ(found.size(), 1U) << depth;
    EXPECT_NEAR(found[0] * length, sigma, 1e-11 * sigma + 1e-17) << depth;
    step.parameter << series(-length), series(0.0);
    found = step_positions(step, p);
    ASSERT_EQ(found.size(), 1U) << depth;
    // Positions near 1 have the rounding error of numbers near 1.
    EXPECT_NEAR((1.0 - found[0]) * length, sigma, 1e-11 * sigma + 1e-16) << depth;
  }
}

/// p = 2 - (t - fold)^2, evaluated at its maximum and up to two rounding units beside it: one place, or none.
TEST(StepPositions, AtAFoldAreOneForEveryRoundingOfItsParameter) {
  std::size_t found_places = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double fold = i == 2000 ? 1.0 : 0.3 + 0.7 * i / 2000.0;
    const PathStep step = curved_step(ComplexVector{{2.0 - fold * fold, 2.0 * fold, -1.0}}, 0.3, 4);
    for (const double units : {-2.0, -1.0, 0.0, 1.0}) {
      const double p = 2.0 + units * std::numeric_limits<double>::epsilon();
      const std::vector<double> found = step_positions(step, p);
      ASSERT_LE(found.size(), 1U) << "fold at " << fold << ", p = 2 + " << units << " units";
      if (found.empty()) continue;
      ++found_places;
      EXPECT_NEAR(found[0], fold, 1e-7);
    }
  }
  EXPECT_GT(found_places, 1000U);
}

TEST(StepPositions, OfAWavyPathAreAll) {
  // p = t (t - 0.5) (t - 1) passes zero at both ends and in the middle.
  const PathStep step = curved_step(ComplexVector{{0.0, 0.5, -1.5, 1.0}}, 2.0, 4);
  const std::vector<double> found = step_positions(step, 0.0);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], 0.0, tolerance);
  EXPECT_NEAR(found[1], 0.5, tolerance);
  EXPECT_NEAR(found[2], 1.0, tolerance);
}

TEST(ChartValue, ExchangesZeroAndInfinity) {
  EXPECT_EQ(chart_value(Complex(2.0, 1.0), Chart::finite), Complex(2.0, 1.0));
  EXPECT_LT(std::abs(chart_value(Complex(0.0, 2.0), Chart::reciprocal) - Complex(0.0, -0.5)), tolerance);
  const Complex infinity = chart_value(0.0, Chart::reciprocal);
  EXPECT_TRUE(std::isinf(infinity.real()));
  EXPECT_EQ(infinity.imag(), 0.0);
  EXPECT_EQ(chart_value(infinity, Chart::reciprocal), Complex(0.0));
}

}  // namespace
}  // namespace eigentrail::test::path_step_test
