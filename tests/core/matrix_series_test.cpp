#include "core/matrix_series.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::matrix_series_test {
namespace {

const MatrixSeries A{Matrix{{2.0, 1.0}, {0.0, 3.0}}, Matrix{{0.5, -1.0}, {2.0, 0.25}},
                     Matrix{{1.0, 0.0}, {-0.5, 1.5}}};
const MatrixSeries B{Matrix{{1.0}, {-2.0}}, Matrix{{0.5}, {4.0}}};

TEST(MatrixSeries, ValueIsThePolynomial) {
  EXPECT_EQ(evaluate_series(A, 2.0), A[0] + 2.0 * A[1] + 4.0 * A[2]);
  EXPECT_EQ(evaluate_series(MatrixSeries{A[1]}, 1e3), A[1]);
}

TEST(MatrixSeries, ValueOfAProductIsTheProductOfTheValues) {
  const MatrixSeries product = multiply_series(A, B, 4);
  EXPECT_TRUE(evaluate_series(product, 0.5).isApprox(evaluate_series(A, 0.5) * evaluate_series(B, 0.5)));
}

TEST(MatrixSeries, ProductIsTruncatedOrFilledUp) {
  const MatrixSeries two = multiply_series(A, B, 2);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1], A[0] * B[1] + A[1] * B[0]);
  const MatrixSeries six = multiply_series(A, B, 6);
  EXPECT_EQ(six[3], A[2] * B[1]);
  EXPECT_EQ(six[5], Matrix::Zero(2, 1));
}

TEST(MatrixSeries, InverseTimesTheSeriesIsOne) {
  const MatrixSeries one = multiply_series(inverse_series(A), A, A.size());
  EXPECT_TRUE(one[0].isIdentity(1e-14));
  for (std::size_t k = 1; k < one.size(); ++k) EXPECT_TRUE(one[k].isZero(1e-14)) << "order " << k;
}

TEST(MatrixSeries, CoefficientsMayBeComplex) {
  std::vector<ComplexMatrix> C;
  for (const Matrix& a : A) C.emplace_back(Complex(1.0, 0.5) * a.cast<Complex>());
  const std::vector<ComplexMatrix> one = multiply_series(C, inverse_series(C), 3);
  EXPECT_TRUE(one[0].isIdentity(1e-14));
  EXPECT_TRUE(one[2].isZero(1e-14));
}

}  // namespace
}  // namespace eigentrail::test::matrix_series_test
