#include "eigentrail/modes/matching.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/families.hpp"

namespace eigentrail::test::normalization_test {
namespace {

// Some ten roundings in each product of a handful of terms.
constexpr double rounding = 1e-14;

ComplexVector random_shape(Eigen::Index n, unsigned seed) {
  return random_complex(n, 1, seed);
}

/// Symmetric positive definite, with couplings.
Matrix mass_matrix(Eigen::Index n) {
  Matrix M = 2.0 * Matrix::Identity(n, n);
  for (Eigen::Index i = 1; i < n; ++i) M(i, i - 1) = M(i - 1, i) = 0.7;
  return M;
}

double mass_norm(const ComplexVector& v, const Matrix& M) {
  return std::sqrt(v.dot(M * v).real());
}

/// Whether a and b differ by a complex factor only: Cauchy-Schwarz with equality.
bool parallel(const ComplexVector& a, const ComplexVector& b) {
  return std::abs(std::abs(a.dot(b)) - a.norm() * b.norm()) <= rounding * a.norm() * b.norm();
}

TEST(NormalizeShape, HasUnitMassNormAndTheSameDirection) {
  const Matrix M = mass_matrix(4);
  for (const double length : {1e-150, 1e-6, 1.0, 1e9}) {
    const ComplexVector v = length * random_shape(4, 1);
    for (const ComplexVector& reference : {ComplexVector(), random_shape(4, 2)}) {
      const ComplexVector shape = normalize_shape(v, M, reference);
      EXPECT_NEAR(mass_norm(shape, M), 1.0, rounding) << length;
      EXPECT_TRUE(parallel(shape, v / length)) << length;
    }
  }
}

TEST(NormalizeShape, OfASingleMassHasClosedForm) {
  const ComplexVector v = ComplexVector::Constant(1, Complex(0.0, -3.0));
  const ComplexVector shape = normalize_shape(v, Matrix::Constant(1, 1, 4.0), ComplexVector());
  EXPECT_NEAR(std::abs(shape[0] - 0.5), 0.0, rounding);
}

TEST(NormalizeShape, OverlapWithTheReferenceIsRealAndPositive) {
  const Matrix M = mass_matrix(4);
  const ComplexVector reference = normalize_shape(random_shape(4, 2), M, ComplexVector());
  for (const double phase : {0.0, 0.4, 1.6, 3.1, -2.0}) {
    const ComplexVector shape = normalize_shape(std::polar(1.0, phase) * random_shape(4, 1), M, reference);
    const Complex overlap = reference.dot(M * shape);
    EXPECT_NEAR(overlap.imag(), 0.0, rounding) << phase;
    EXPECT_GT(overlap.real(), 0.0) << phase;
  }
}

TEST(NormalizeShape, FollowsAReferenceSmoothlyWhereTheLargestComponentChanges) {
  // v(t) turns from the first component to the second. A normalization that makes the largest component real
  // would jump.
  const Matrix M = Matrix::Identity(2, 2);
  const auto v = [](double t) {
    ComplexVector shape(2);
    shape << std::cos(t), std::polar(std::sin(t), 1.0);
    return shape;
  };
  constexpr double step = 0.01;
  // The shape moves by `step` per step, and its phase by at most as much.
  constexpr double smooth = 3 * step;
  double largest_step = 0.0;
  double largest_step_of_rival = 0.0;
  ComplexVector before = normalize_shape(v(0.3), M, ComplexVector());
  ComplexVector rival_before = before;
  for (double t = 0.3 + step; t < 1.3; t += step) {
    const ComplexVector shape = normalize_shape(v(t), M, before);
    const ComplexVector rival = normalize_shape(v(t), M, ComplexVector());
    largest_step = std::max(largest_step, (shape - before).norm());
    largest_step_of_rival = std::max(largest_step_of_rival, (rival - rival_before).norm());
    before = shape;
    rival_before = rival;
  }
  EXPECT_LT(largest_step, smooth);
  EXPECT_GT(largest_step_of_rival, 10 * smooth);
}

/// Whether the component of largest magnitude is real and positive.
bool largest_is_positive(const ComplexVector& shape) {
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  return shape[largest].real() > 0.0 && std::abs(shape[largest].imag()) <= rounding;
}

TEST(NormalizeShape, WithoutAUsableReferenceMakesTheLargestComponentPositive) {
  const Matrix M = mass_matrix(4);
  const ComplexVector v = random_shape(4, 1);
  const ComplexVector other = normalize_shape(random_shape(4, 2), M, ComplexVector());
  const ComplexVector Mv = M * v;
  const ComplexVector orthogonal = other - v * (Mv.dot(other) / Mv.dot(v));
  EXPECT_TRUE(largest_is_positive(normalize_shape(v, M, ComplexVector())));
  EXPECT_TRUE(largest_is_positive(normalize_shape(v, M, orthogonal)));
  EXPECT_FALSE(largest_is_positive(normalize_shape(v, M, other))) << "with a reference it is not";
}

TEST(NormalizeShape, ThatMovesNoMassHasUnitLength) {
  const Matrix M = Eigen::Vector3d(2.0, 0.0, 0.0).asDiagonal();
  ComplexVector v(3);
  v << 0.0, Complex(0.0, -3.0), 4.0;
  const ComplexVector shape = normalize_shape(v, M, ComplexVector());
  EXPECT_NEAR(shape.norm(), 1.0, rounding);
  EXPECT_TRUE(largest_is_positive(shape));
  ComplexVector reference(3);
  reference << 0.0, 1.0, 0.0;
  EXPECT_NEAR(std::abs(normalize_shape(v, M, reference)[1] - 0.6), 0.0, rounding);
}

TEST(NormalizeShape, OfMixedUnitsCountsMassNotComponents) {
  // A light component moves far: the mass norm counts, and the reference decides by mass too.
  const Matrix M = Eigen::Vector2d(1.0, 1e-6).asDiagonal();
  ComplexVector v(2), reference(2);
  v << Complex(0.0, 1.0), 100.0;
  reference << 1.0, 1.0;
  const ComplexVector shape = normalize_shape(v, M, reference);
  EXPECT_NEAR(mass_norm(shape, M), 1.0, rounding);
  EXPECT_NEAR(std::arg(reference.dot(M * shape)), 0.0, rounding);
  EXPECT_LT(std::abs(std::arg(shape[0])), 1e-3) << "not the component that is largest in numbers";
}

}  // namespace
}  // namespace eigentrail::test::normalization_test
