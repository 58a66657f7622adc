// Matrices in band storage, against the same as full ones.
#include "core/band_matrix.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace eigentrail::test::band_matrix_test {
namespace {

/// n x n with random entries up to `width` from the diagonal.
template <class Values>
Values random_band(Eigen::Index n, Eigen::Index width) {
  Values A = Values::Random(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i < n; ++i) {
      if (std::abs(i - j) > width) A(i, j) = 0.0;
    }
  }
  return A;
}

TEST(BandWidth, IsThatOfTheEntryFarthestFromTheDiagonal) {
  Matrix A = Matrix::Zero(7, 7);
  EXPECT_EQ(band_width(A), 0);
  EXPECT_EQ(band_width(A, 3), 3);
  A(6, 4) = 1e-300;
  EXPECT_EQ(band_width(A), 2);
  A(0, 5) = -1.0;
  EXPECT_EQ(band_width(A), 5);
  A(6, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(band_width(A), 6);
  EXPECT_EQ(band_width(Matrix()), 0);
}

TEST(BandProduct, IsThatOfTheFullMatrix) {
  for (const Eigen::Index width : {0, 1, 4, 8}) {
    const Matrix A = random_band<Matrix>(9, width);
    const ComplexMatrix X = ComplexMatrix::Random(9, 3);
    EXPECT_LT((band_product(band_of(A, width), X) - A * X).norm(), 1e-14) << width;
    EXPECT_LT((transposed_band_product(band_of(A, width), X) - A.transpose() * X).norm(), 1e-14) << width;
  }
}

TEST(BandProduct, IsAddedForComplexMatrices) {
  const Matrix real = random_band<Matrix>(9, 2);
  const Matrix imaginary = random_band<Matrix>(9, 2);
  ComplexMatrix A(9, 9), band(5, 9);
  A.real() = real;
  A.imag() = imaginary;
  band.real() = band_of(real, 2);
  band.imag() = band_of(imaginary, 2);
  const ComplexVector x = ComplexVector::Random(9), before = ComplexVector::Random(9);
  ComplexVector y = before;
  add_band_product(band, x.data(), y.data());
  EXPECT_LT((y - before - A * x).norm(), 1e-14);
  y = before;
  add_adjoint_band_product(band, x.data(), y.data());
  EXPECT_LT((y - before - A.adjoint() * x).norm(), 1e-14);
}

TEST(BandCholesky, IsATriangularRoot) {
  for (const Eigen::Index width : {0, 3, 7}) {
    const Matrix part = random_band<Matrix>(8, width);
    const Matrix A = part + part.transpose() + 40.0 * Matrix::Identity(8, 8);
    const BandCholesky root(A);
    ASSERT_TRUE(root.exists());
    const ComplexVector x = ComplexVector::Random(8);
    ComplexVector y = x;
    root.apply(y.data());
    EXPECT_NEAR(y.squaredNorm(), x.dot(A * x).real(), 1e-12 * y.squaredNorm());
    root.apply_transposed(y.data());
    EXPECT_LT((y - A * x).norm(), 1e-13 * y.norm()) << width;
    root.solve_transposed(y.data());
    root.solve(y.data());
    EXPECT_LT((y - x).norm(), 1e-13) << width;
    EXPECT_EQ(root.width(), width);
    EXPECT_LT((root.full().transpose() * root.full() - A).norm(), 1e-13 * A.norm());
    EXPECT_LT((root.full() * root.full_inverse() - Matrix::Identity(8, 8)).norm(), 1e-13);
  }
}

TEST(BandCholesky, DoesNotExistOfIndefiniteOrEmptyMatricesOrOfNoNumbers) {
  EXPECT_FALSE(BandCholesky(Matrix{{1.0, 2.0}, {2.0, 1.0}}).exists());
  EXPECT_FALSE(BandCholesky(Matrix::Zero(2, 2)).exists());
  EXPECT_FALSE(BandCholesky(Matrix()).exists());
  EXPECT_FALSE(BandCholesky(std::numeric_limits<double>::quiet_NaN() * Matrix::Identity(2, 2)).exists());
}

}  // namespace
}  // namespace eigentrail::test::band_matrix_test
