// Blocks of a matrix, products that leave zeros out, and null spaces block by block.
#include "core/diagonal_blocks.hpp"

#include <gtest/gtest.h>

#include "core/products.hpp"
#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail::test::diagonal_blocks_test {
namespace {

using Indices = std::vector<Eigen::Index>;

constexpr double rounding = 1e-13;

SparseMatrix sparse(const Matrix& values) {
  return values.sparseView();
}

TEST(DiagonalBlocks, AreWhatNoEntryConnects) {
  Matrix A = Matrix::Zero(4, 6);
  A(0, 0) = A(0, 4) = A(2, 4) = A(1, 2) = A(1, 5) = 1.0;  // row 3 and columns 1, 3 are empty
  const std::vector<DiagonalBlock> blocks = diagonal_blocks(sparse(A));
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].rows, (Indices{0, 2}));
  EXPECT_EQ(blocks[0].columns, (Indices{0, 4}));
  EXPECT_EQ(blocks[1].rows, Indices());
  EXPECT_EQ(blocks[1].columns, Indices{1});
  EXPECT_EQ(blocks[2].rows, Indices{1});
  EXPECT_EQ(blocks[2].columns, (Indices{2, 5}));
  EXPECT_EQ(blocks[3].columns, Indices{3});
}

TEST(DiagonalBlocks, AChainIsOne) {
  Matrix A = Matrix::Identity(50, 51);
  A.diagonal(1).setOnes();
  const std::vector<DiagonalBlock> blocks = diagonal_blocks(sparse(A));
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].rows.size(), 50U);
  EXPECT_EQ(blocks[0].columns.size(), 51U);
}

TEST(DiagonalBlocks, OfASeriesAreThoseOfAllItsCoefficients) {
  Matrix off_diagonal = Matrix::Zero(3, 3);
  off_diagonal(0, 2) = -1e-30;
  EXPECT_EQ(diagonal_blocks(MatrixSeries{Matrix::Identity(3, 3)}).size(), 3U);
  EXPECT_EQ(diagonal_blocks(MatrixSeries{Matrix::Identity(3, 3), off_diagonal}).size(), 2U);
}

/// Blocks of 2 x 5 with random entries, shuffled.
Matrix random_blocks(int count) {
  Matrix A = Matrix::Zero(2 * count, 5 * count);
  for (int b = 0; b < count; ++b) {
    for (int j = 0; j < 5; ++j)
      A.col((b + count * j) % (5 * count)).segment(2 * b, 2) = Eigen::Vector2d::Random();
  }
  return A;
}

TEST(DiagonalBlocks, HaveNullSpacesOfTheirOwn) {
  const Matrix A = random_blocks(20);
  const ConstraintFactorization constraints(sparse(A));
  ASSERT_TRUE(constraints.is_sparse());
  const Matrix& Q = constraints.null_basis();
  ASSERT_EQ(Q.cols(), 60);
  EXPECT_LT((A * Q).norm(), rounding);
  EXPECT_LT((Q.transpose() * Q - Matrix::Identity(60, 60)).norm(), rounding);
  EXPECT_EQ(diagonal_blocks(sparse(Q)).size(), 20U);
}

TEST(DiagonalBlocks, ArePackedIntoTheColumnsOfTheLargest) {
  const Matrix A = random_blocks(20).transpose();
  const auto blocks = diagonal_blocks(MatrixSeries{A});
  const Matrix P = packed(A, blocks);
  EXPECT_EQ(P.cols(), A.cols() / 20);
  EXPECT_EQ(unpacked(P, blocks, A.cols()), A);
  const Matrix all = Matrix::Random(6, 3);  // one block
  EXPECT_EQ(packed(all, diagonal_blocks(MatrixSeries{all})), all);
}

TEST(SparseProducts, AreTheDenseOnes) {
  MatrixSeries T, dense;
  for (int k = 0; k < 3; ++k) {
    T.push_back(random_blocks(15).transpose());
    dense.push_back(Matrix::Random(75, 75));
  }
  ASSERT_TRUE(mostly_zero(T));
  EXPECT_FALSE(mostly_zero(MatrixSeries{T[0], Matrix::Random(75, 30)}));
  SystemSeries B;
  for (const Matrix& coefficient : dense) B.emplace_back(sparse(coefficient));
  EXPECT_FALSE(SparseCongruence::of(dense, T));
  EXPECT_FALSE(SparseCongruence::of(T, dense));
  const MatrixSeries BT = product(dense, T, 4), TBT = transposed_product(T, BT, 4);
  const auto with_T = SparseCongruence::of(T, T), with_copy = SparseCongruence::of(T, MatrixSeries(T));
  ASSERT_TRUE(with_T && with_copy);
  const MatrixSeries together = (*with_T)(B, 4);
  ASSERT_EQ(together.size(), 4U);
  EXPECT_EQ(together, (*with_copy)(B, 4));
  for (std::size_t k = 0; k < 4; ++k) {
    Matrix expected_BT = Matrix::Zero(75, 30), expected = Matrix::Zero(30, 30);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        if (i + j == k) expected_BT += dense[i] * T[j];
        for (std::size_t l = 0; l < 3; ++l) {
          if (i + j + l == k) expected += T[l].transpose() * dense[i] * T[j];
        }
      }
    }
    EXPECT_LT((BT[k] - expected_BT).norm(), rounding * expected_BT.norm());
    EXPECT_LT((TBT[k] - expected).norm(), rounding * expected.norm());
    EXPECT_LT((together[k] - expected).norm(), rounding * expected.norm());
  }
}

TEST(SparseProducts, HaveNoMoreCoefficientsThanThereAre) {
  const Matrix one = Matrix::Identity(12, 12);
  EXPECT_EQ(SparseCongruence::of({one}, {one}).value()({sparse(one)}, 6).size(), 1U);
}

}  // namespace
}  // namespace eigentrail::test::diagonal_blocks_test
