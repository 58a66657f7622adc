#include "continuation/step/step_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace eigentrail::test::least_magnitude_test {
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

TEST(LeastMagnitude, OneMemberOfABlockThatVanishesIsEnough) {
  // s1 = t - 0.4 beside s2 = -1: tau = (t - 1.4) / 2, delta = ((t + 0.6) / 2)^2.
  const ComplexMatrix functions = (ComplexMatrix(2, 3) << -0.7, 0.5, 0.0, 0.09, 0.3, 0.25).finished();
  EXPECT_NEAR(place_of_least_magnitude(functions), 0.4, 2e-5);
  // The same with s3 = 2, as a matrix.
  ComplexMatrix matrix = ComplexMatrix::Zero(9, 2);
  matrix(0, 0) = -0.4;
  matrix(0, 1) = 1.0;
  matrix(4, 0) = -1.0;
  matrix(8, 0) = 2.0;
  EXPECT_NEAR(place_of_least_magnitude(matrix), 0.4, 2e-5);
}

}  // namespace
}  // namespace eigentrail::test::least_magnitude_test
