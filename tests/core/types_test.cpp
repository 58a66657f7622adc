#include "eigentrail/core/types.hpp"

#include <gtest/gtest.h>

namespace eigentrail::test::types_test {
namespace {

TEST(EvaluateSeries, IsThePolynomialInEveryRow) {
  VectorSeries series(2, 4);
  series << 1.0, -2.0, 3.0, 0.5,  //
      0.25, 0.0, 0.0, -4.0;
  const Vector value = evaluate_series(series, 2.0);
  EXPECT_EQ(value[0], 1.0 - 4.0 + 12.0 + 4.0);
  EXPECT_EQ(value[1], 0.25 - 32.0);
}

TEST(EvaluateSeries, OfASingleColumnIsThatColumn) {
  const ComplexMatrix series = ComplexMatrix::Constant(3, 1, Complex(1.0, -2.0));
  const ComplexVector value = evaluate_series(series, 1e3);
  EXPECT_EQ(value, ComplexVector::Constant(3, Complex(1.0, -2.0)));
}

TEST(Coefficient, IsZeroBeyondTheEndOfTheSeries) {
  VectorSeries series(1, 2);
  series << 3.0, 5.0;
  EXPECT_EQ(coefficient(series, 0, 1), 5.0);
  EXPECT_EQ(coefficient(series, 0, 2), 0.0);
}

}  // namespace
}  // namespace eigentrail::test::types_test
