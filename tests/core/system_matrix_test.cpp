#include "eigentrail/core/system_matrix.hpp"

#include <gtest/gtest.h>

#include <random>

namespace eigentrail::test::system_matrix_test {
namespace {

constexpr double rounding = 1e-14;

/// A third of the entries are not zero.
Matrix sparse_values(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution there(0.3);
  return Matrix::NullaryExpr(rows, columns, [&] { return there(engine) ? normal(engine) : 0.0; });
}

SystemMatrix sparse(const Matrix& values) {
  return SparseMatrix(values.sparseView());
}

struct Kinds : testing::TestWithParam<bool> {
  SystemMatrix of(const Matrix& values) const { return GetParam() ? sparse(values) : SystemMatrix(values); }
};

static_assert(!std::is_convertible_v<SystemMatrix, Matrix>, "only dense() may take n^2 numbers");

TEST_P(Kinds, HoldTheSameNumbers) {
  const Matrix values = sparse_values(7, 5, 1);
  const SystemMatrix B = of(values);
  EXPECT_EQ(B.is_sparse(), GetParam());
  EXPECT_EQ(B.dense(), values);
  EXPECT_EQ(B.rows(), 7);
  EXPECT_EQ(B.cols(), 5);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(B(i, 2), values(i, 2));
}

TEST_P(Kinds, HaveTheSameNorms) {
  const Matrix values = sparse_values(7, 5, 2);
  const SystemMatrix B = of(values);
  EXPECT_NEAR(B.norm(), values.norm(), rounding);
  EXPECT_NEAR(B.one_norm(), values.cwiseAbs().colwise().sum().maxCoeff(), rounding);
  EXPECT_EQ(B.largest_entry(), values.cwiseAbs().maxCoeff());
  EXPECT_LT((B.row_norms() - values.rowwise().norm()).norm(), rounding);
}

TEST_P(Kinds, MultiplyAlike) {
  const Matrix values = sparse_values(7, 5, 3);
  const SystemMatrix B = of(values);
  const Matrix right = Matrix::Random(5, 3), left = Matrix::Random(2, 7);
  const Vector x = Vector::Random(7);
  EXPECT_LT((B * right - values * right).norm(), rounding);
  EXPECT_LT((left * B - left * values).norm(), rounding);
  EXPECT_LT((B.transposed_times(x) - values.transpose() * x).norm(), rounding);
  Matrix sum = Matrix::Ones(7, 3);
  B.add_product_to(sum, right);
  EXPECT_LT((sum - Matrix::Ones(7, 3) - values * right).norm(), rounding);
}

TEST_P(Kinds, AddAlike) {
  const Matrix a = sparse_values(6, 6, 4), b = sparse_values(6, 6, 5);
  SystemMatrix sum = of(a);
  sum.add_scaled(-2.0, of(b));
  EXPECT_EQ(sum.is_sparse(), GetParam());
  EXPECT_LT((sum.dense() - (a - 2.0 * b)).norm(), rounding);
  EXPECT_TRUE(sum.zero().is_zero());
  EXPECT_FALSE(sum.is_zero());
  EXPECT_EQ(sum.zero().is_sparse(), GetParam());
}

TEST_P(Kinds, MayBeEmpty) {
  const SystemMatrix B = of(Matrix(0, 4));
  EXPECT_EQ(B.size(), 0);
  EXPECT_EQ(B.norm(), 0.0);
  EXPECT_EQ(B.one_norm(), 0.0);
  EXPECT_EQ(B.largest_entry(), 0.0);
  EXPECT_EQ(B.row_norms().size(), 0);
  EXPECT_EQ(B.transposed_times(Vector(0)), Vector::Zero(4));
}

INSTANTIATE_TEST_SUITE_P(SystemMatrix, Kinds, testing::Bool(),
                         [](const auto& of) { return of.param ? "sparse" : "dense"; });

TEST(SystemMatrix, CoefficientsOfOneSeriesAreOfOneKind) {
  SystemMatrix sum(Matrix::Identity(3, 3));
  EXPECT_THROW(sum.add_scaled(1.0, sparse(Matrix::Identity(3, 3))), std::bad_variant_access);
  EXPECT_THROW(sum.sparse(), std::bad_variant_access);
}

}  // namespace
}  // namespace eigentrail::test::system_matrix_test
