#include "eigentrail/reduction/reduced_pencil.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reduction/projected.hpp"
#include "support/families.hpp"

namespace eigentrail::test::reduced_pencil_test {
namespace {

MatrixSeries random_series(std::size_t length, Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  MatrixSeries series;
  for (std::size_t k = 0; k < length; ++k) {
    series.push_back(Matrix::NullaryExpr(rows, columns, [&] { return normal(engine); }));
  }
  return series;
}

SystemSeries system(const MatrixSeries& B) {
  return {B.begin(), B.end()};
}

TEST(ReducedPencil, SeriesProductMatchesTheProductOfTheSeries) {
  const TangentBasis basis{random_series(5, 6, 3, 1), false};
  const MatrixSeries B = random_series(5, 6, 6, 2);
  for (int order = 1; order <= 4; ++order) {
    const MatrixSeries result = project(basis, system(B), order);
    ASSERT_EQ(result.size(), static_cast<std::size_t>(order) + 1);
    const auto miss = [&](double h) {
      const Matrix T = evaluate(basis.T, h);
      return (T.transpose() * evaluate(B, h) * T - evaluate(result, h)).norm();
    };
    EXPECT_NEAR(std::log2(miss(2e-3) / miss(1e-3)), order + 1.0, 0.1);
  }
}

TEST(ReducedPencil, FirstOrderIsEquation36) {
  const TangentBasis basis{random_series(2, 5, 2, 3), false};
  const MatrixSeries B = random_series(2, 5, 5, 4);
  const Matrix& T = basis.T[0];
  const Matrix& dT = basis.T[1];
  const Matrix expected = dT.transpose() * B[0] * T + T.transpose() * B[1] * T + T.transpose() * B[0] * dT;
  EXPECT_LT((project(basis, system(B), 1)[1] - expected).norm(), 1e-13 * expected.norm());
}

TEST(ReducedPencil, ConstantsStayConstant) {
  const TangentBasis basis{random_series(1, 5, 2, 5), false};
  EXPECT_EQ(project(basis, system(random_series(1, 5, 5, 6)), 4).size(), 1U);
  EXPECT_EQ(project(basis, system(random_series(3, 5, 5, 6)), 4).size(), 3U);
}

TEST(ReducedPencil, IdentityCopies) {
  const TangentBasis basis{{Matrix::Identity(4, 4)}, true};
  const MatrixSeries B = random_series(4, 4, 4, 7);
  const MatrixSeries copied = project(basis, system(B), 2);
  ASSERT_EQ(copied.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(copied[k], B[k]);
}

}  // namespace
}  // namespace eigentrail::test::reduced_pencil_test
