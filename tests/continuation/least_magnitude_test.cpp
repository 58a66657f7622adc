#include "continuation/least_magnitude.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail {
namespace {

/// Coefficients of (t - a) (t - b).
ComplexMatrix with_zeros(Complex a, Complex b) {
  return (ComplexMatrix(1, 3) << a * b, -(a + b), 1.0).finished();
}

TEST(LeastMagnitude, ZeroBetweenTheSamplesIsFound) {
  const ComplexMatrix line = (ComplexMatrix(1, 2) << -0.3137, 1.0).finished();
  EXPECT_NEAR(place_of_least_magnitude(line), 0.3137, 2e-5);
}

TEST(LeastMagnitude, NearPassageOfAComplexEigenvalueIsFound) {
  // |s| is least where the real part vanishes.
  const ComplexMatrix line = (ComplexMatrix(1, 2) << Complex(-0.7071, 1e-4), 1.0).finished();
  EXPECT_NEAR(place_of_least_magnitude(line), 0.7071, 2e-5);
}

TEST(LeastMagnitude, LowerOneOfTwoDipsIsFound) {
  EXPECT_NEAR(place_of_least_magnitude(with_zeros(Complex(0.21, 0.05), Complex(0.83, 0.001))), 0.83, 1e-3);
  EXPECT_NEAR(place_of_least_magnitude(with_zeros(Complex(0.21, 0.001), Complex(0.83, 0.05))), 0.21, 1e-3);
}

TEST(LeastMagnitude, EndOfTheStepIsAPlaceToo) {
  const ComplexMatrix rising = (ComplexMatrix(1, 2) << 1.0, 1.0).finished();
  EXPECT_EQ(place_of_least_magnitude(rising), 0.0);
  const ComplexMatrix falling = (ComplexMatrix(1, 2) << 2.0, -1.0).finished();
  EXPECT_EQ(place_of_least_magnitude(falling), 1.0);
}

TEST(LeastMagnitude, BlockIsSmallWhereAllItsEigenvaluesAre) {
  // s = 1 +- 1, one of which vanishes throughout, has the same size as tau = 1 alone would have with s = 1 +-
  // i. Here tau = t - 0.4 and delta = (t - 0.4)^2 + 0.01: both eigenvalues are smallest at 0.4.
  const ComplexMatrix functions =
      (ComplexMatrix(2, 3) << -0.4, 1.0, 0.0, 0.4 * 0.4 + 0.01, -0.8, 1.0).finished();
  EXPECT_NEAR(place_of_least_magnitude(functions), 0.4, 1e-3);
  // Two on either side of zero are not small although their mean is.
  const ComplexMatrix apart = (ComplexMatrix(2, 2) << -0.4, 1.0, 4.0, -3.9).finished();
  EXPECT_GT(place_of_least_magnitude(apart), 0.9);
}

}  // namespace
}  // namespace eigentrail
