// Tangent basis, its series and the projection with sparse matrices, compared with dense matrices.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "reduction/projected.hpp"

namespace eigentrail::test::sparse_reduction_test {
namespace {

constexpr double rounding = 1e-13;
constexpr int points = 30, n = 3 * points;

/// Directions of the links of a chain in space, turning with h; as a series of order 3.
std::vector<Matrix> link_directions() {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  std::vector<Matrix> series;
  for (int k = 0; k < 4; ++k)
    series.push_back(std::pow(0.5, k) * Matrix::NullaryExpr(3, points, [&] { return normal(engine); }));
  return series;
}

/// Rows of the rods between neighbours.
Matrix rows_of(const Matrix& directions) {
  Matrix A = Matrix::Zero(points, n);
  for (int i = 0; i < points; ++i) {
    A.block(i, 3 * i, 1, 3) = directions.col(i).transpose();
    if (i > 0) A.block(i, 3 * i - 3, 1, 3) = -directions.col(i).transpose();
  }
  return A;
}

SystemMatrix sparse(const Matrix& values) {
  return SparseMatrix(values.sparseView());
}

struct Chain {
  SystemSeries dense, by_sparse;

  Chain() {
    for (const Matrix& directions : link_directions()) {
      dense.emplace_back(rows_of(directions));
      by_sparse.push_back(sparse(rows_of(directions)));
    }
  }
  Matrix at(double h) const {
    Matrix value = dense.back().dense();
    for (std::size_t k = dense.size() - 1; k-- > 0;) value = value * h + dense[k].dense();
    return value;
  }
};

TEST(SparseReduction, FirstBasisIsThatOfTheDenseRoute) {
  const Chain chain;
  const TangentBasis basis = tangent_basis(ConstraintFactorization(chain.by_sparse[0]), Matrix());
  const Matrix& T = basis.T[0];
  EXPECT_LT((T.transpose() * T - Matrix::Identity(n - points, n - points)).norm(), 10 * rounding);
  EXPECT_LT((chain.at(0.0).rowwise().normalized() * T).norm(), 10 * rounding);
}

TEST(SparseReduction, NextBasisIsThatOfTheDenseRouteToRounding) {
  const Chain chain;
  const Matrix previous = tangent_basis(ConstraintFactorization(chain.dense[0]), Matrix()).T[0];
  for (const double h : {1e-6, 1e-2, 0.1}) {
    const ConstraintFactorization by_sparse(sparse(chain.at(h)));
    ASSERT_TRUE(by_sparse.is_sparse());
    const Matrix T = tangent_basis(by_sparse, previous).T[0];
    EXPECT_LT((T.transpose() * T - Matrix::Identity(n - points, n - points)).norm(), 10 * rounding) << h;
    EXPECT_LT((chain.at(h).rowwise().normalized() * T).cwiseAbs().maxCoeff(), rounding) << h;
    const Matrix expected = tangent_basis(ConstraintFactorization(chain.at(h)), previous).T[0];
    EXPECT_LT((T - expected).norm(), 100 * rounding) << h;
  }
}

TEST(SparseReduction, BasisThatTurnedByARightAngleStartsAfresh) {
  const Chain chain;
  const ConstraintFactorization by_sparse(chain.by_sparse[0]);
  const Matrix T0 = by_sparse.null_basis();
  Matrix previous = T0;
  previous.col(0) = chain.at(0.0).row(0).normalized().transpose();  // not a motion that is allowed
  const Matrix T = tangent_basis(by_sparse, previous).T[0];
  EXPECT_LT((T.transpose() * T - Matrix::Identity(n - points, n - points)).norm(), 10 * rounding);
  EXPECT_LT((chain.at(0.0).rowwise().normalized() * T).cwiseAbs().maxCoeff(), rounding);
}

TEST(SparseReduction, BasisOfAnotherSizeIsIgnored) {
  const ConstraintFactorization by_sparse(Chain().by_sparse[0]);
  EXPECT_EQ(tangent_basis(by_sparse, Matrix::Identity(n, 5)).T[0], by_sparse.null_basis());
}

TEST(SparseReduction, SeriesOfTheBasisIsThatOfTheDenseRoute) {
  const Chain chain;
  const ConstraintFactorization by_sparse(chain.by_sparse[0]), dense(chain.dense[0]);
  TangentBasis a{{dense.null_basis()}, false}, b = a;
  differentiate_basis(by_sparse, chain.by_sparse, 5, a);
  differentiate_basis(dense, chain.dense, 5, b);
  ASSERT_EQ(a.T.size(), b.T.size());
  for (std::size_t k = 0; k < a.T.size(); ++k)
    EXPECT_LT((a.T[k] - b.T[k]).norm(), 10 * rounding * b.T[k].norm()) << k;
}

TEST(SparseReduction, ProjectionIsThatOfTheDenseRoute) {
  const Chain chain;
  TangentBasis basis{{ConstraintFactorization(chain.dense[0]).null_basis()}, false};
  differentiate_basis(ConstraintFactorization(chain.dense[0]), chain.dense, 4, basis);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  SystemSeries dense, by_sparse;
  for (int k = 0; k < 3; ++k) {
    Matrix B = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = std::max(0, i - 3); j < std::min(n, i + 4); ++j) B(i, j) = normal(engine);
    }
    dense.emplace_back(B);
    by_sparse.push_back(sparse(B));
  }
  const MatrixSeries expected = project(basis, dense, 4), found = project(basis, by_sparse, 4);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_LT((found[k] - expected[k]).norm(), rounding * expected[k].norm()) << k;
}

TEST(SparseReduction, WithoutConstraintsThePencilIsCopied) {
  const TangentBasis basis = tangent_basis(ConstraintFactorization(sparse(Matrix(0, 4))), Matrix());
  ASSERT_TRUE(basis.is_identity);
  const Matrix B = Matrix::Identity(4, 4);
  EXPECT_EQ(project(basis, SystemSeries{sparse(B)}, 3).front(), B);
}

}  // namespace
}  // namespace eigentrail::test::sparse_reduction_test
