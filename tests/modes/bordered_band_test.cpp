// Factors of a banded matrix with a border, against those of the full matrix.
#include "modes/bordered_band.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/band_matrix.hpp"

namespace eigentrail::test::bordered_band_test {
namespace {

constexpr Eigen::Index n = 30;
constexpr Eigen::Index width = 3;

/// A band P with k null vectors in its leading coordinates, so that its leading columns depend on each other,
/// and a border that makes the whole regular.
struct Bordered {
  explicit Bordered(Eigen::Index k) : Z(ComplexMatrix::Zero(n, k)) {
    Matrix real = Matrix::Random(n, n), imaginary = Matrix::Random(n, n);
    for (Matrix* part : {&real, &imaginary}) {
      for (Eigen::Index j = 0; j < n; ++j) {
        for (Eigen::Index i = 0; i < n; ++i) {
          if (std::abs(i - j) > width) (*part)(i, j) = 0.0;
        }
      }
      for (Eigen::Index j = 0; j < 2 * k; j += 2) {
        if (j >= width) (*part)(j - width, j) = 0.0;  // outside of the band in the next column
        part->col(j + 1) = -2.0 * part->col(j);
      }
    }
    for (Eigen::Index i = 0; i < k; ++i) Z.col(i).segment(2 * i, 2) << 2.0, 1.0;
    band.resize(2 * width + 1, n);
    band.real() = band_of(real, width);
    band.imag() = band_of(imaginary, width);
    X = ComplexMatrix::Random(n, k);
    Y = ComplexMatrix::Random(k, n);
    D = ComplexMatrix::Random(k, k);
    whole.resize(n + k, n + k);
    whole.topLeftCorner(n, n).real() = real;
    whole.topLeftCorner(n, n).imag() = imaginary;
    whole.topRightCorner(n, k) = X;
    whole.bottomLeftCorner(k, n) = Y;
    whole.bottomRightCorner(k, k) = D;
  }
  ComplexMatrix Z, band, X, Y, D, whole;
};

class BorderOf : public testing::TestWithParam<int> {};

TEST_P(BorderOf, SolvesItsEquationsAndTheirAdjointWhereTheBandIsSingular) {
  const Bordered matrix(GetParam());
  ASSERT_EQ(Eigen::FullPivLU<ComplexMatrix>(matrix.whole.topLeftCorner(n, n)).rank(), n - GetParam());
  const BorderedBand factors(matrix.band, matrix.Z, matrix.X, matrix.Y, matrix.D);
  EXPECT_TRUE(factors.is_accurate());
  const ComplexMatrix x = ComplexMatrix::Random(n + GetParam(), 3);
  ComplexMatrix solution = matrix.whole * x;
  factors.solve_in_place(solution);
  EXPECT_LT((solution - x).norm(), 1e-11 * x.norm());
  ComplexMatrix adjoint = matrix.whole.adjoint() * x;
  factors.solve_adjoint_in_place(adjoint);
  EXPECT_LT((adjoint - x).norm(), 1e-11 * x.norm());
  ComplexVector column = matrix.whole * x.col(1);
  factors.solve_in_place(column);
  EXPECT_LT((column - x.col(1)).norm(), 1e-11 * x.norm());
  column = matrix.whole.adjoint() * x.col(1);
  factors.solve_adjoint_in_place(column);
  EXPECT_LT((column - x.col(1)).norm(), 1e-11 * x.norm());
}

INSTANTIATE_TEST_SUITE_P(Columns, BorderOf, testing::Values(1, 2, 3));

/// The null vector is zero where it is thought to be largest.
TEST(BorderedBand, IsNotAccurateWithOtherVectors) {
  const Bordered matrix(1);
  const ComplexMatrix other = ComplexMatrix::Identity(n, n).col(20);
  EXPECT_FALSE(BorderedBand(matrix.band, other, matrix.X, matrix.Y, matrix.D).is_accurate());
}

/// As of two eigenvalues with one vector: P has one null vector, and two columns of the border are parallel.
TEST(BorderedBand, IsNotAccurateWhereTheBorderHasLowRank) {
  Bordered matrix(1);
  const ComplexMatrix X = matrix.X.replicate(1, 2), Z = matrix.Z.replicate(1, 2);
  const ComplexMatrix Y = ComplexMatrix::Random(2, n), D = ComplexMatrix::Random(2, 2);
  EXPECT_FALSE(BorderedBand(matrix.band, Z, X, Y, D).is_accurate());
}

TEST(BorderedBand, OfASingularMatrixGivesNothingFinite) {
  Bordered matrix(1);
  matrix.X.setZero();
  const BorderedBand factors(matrix.band, matrix.Z, matrix.X, matrix.Y, ComplexMatrix::Zero(1, 1));
  ComplexVector b = ComplexVector::Ones(n + 1);
  factors.solve_in_place(b);
  EXPECT_FALSE(b.allFinite());
}

}  // namespace
}  // namespace eigentrail::test::bordered_band_test
