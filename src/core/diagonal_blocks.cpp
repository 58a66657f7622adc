#include "core/diagonal_blocks.hpp"

#include <algorithm>
#include <numeric>

namespace eigentrail {
namespace {

/// Disjoint sets of columns, each known by its first column.
class ColumnSets {
 public:
  explicit ColumnSets(Eigen::Index columns) : parent_(static_cast<std::size_t>(columns)) {
    std::iota(parent_.begin(), parent_.end(), Eigen::Index(0));
  }

  /// Halves the way to it for the next time.
  Eigen::Index first(Eigen::Index column) {
    while (parent(column) != column) column = parent(column) = parent(parent(column));
    return column;
  }

  void join(Eigen::Index a, Eigen::Index b) {
    a = first(a);
    b = first(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  Eigen::Index& parent(Eigen::Index column) { return parent_[static_cast<std::size_t>(column)]; }

  std::vector<Eigen::Index> parent_;
};

}  // namespace

std::vector<DiagonalBlock> diagonal_blocks(const SparseMatrix& A) {
  constexpr Eigen::Index none = -1;
  ColumnSets sets(A.cols());
  std::vector<Eigen::Index> column_of(static_cast<std::size_t>(A.rows()), none);  // one with an entry there
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      Eigen::Index& known = column_of[static_cast<std::size_t>(entry.row())];
      if (known == none)
        known = j;
      else
        sets.join(known, j);
    }
  }
  std::vector<DiagonalBlock> blocks;
  std::vector<std::size_t> block_of(static_cast<std::size_t>(A.cols()));  // by the first column of a set
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    const auto first = static_cast<std::size_t>(sets.first(j));
    if (static_cast<Eigen::Index>(first) == j) {
      block_of[first] = blocks.size();
      blocks.emplace_back();
    }
    blocks[block_of[first]].columns.push_back(j);
  }
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Eigen::Index column = column_of[static_cast<std::size_t>(i)];
    if (column != none) blocks[block_of[static_cast<std::size_t>(sets.first(column))]].rows.push_back(i);
  }
  return blocks;
}

std::vector<DiagonalBlock> diagonal_blocks(const MatrixSeries& all) {
  Matrix magnitudes = Matrix::Zero(all[0].rows(), all[0].cols());
  for (const Matrix& matrix : all) magnitudes += matrix.cwiseAbs();
  return diagonal_blocks(SparseMatrix(magnitudes.sparseView()));
}

Eigen::Index largest_width(const std::vector<DiagonalBlock>& blocks) {
  Eigen::Index width = 0;
  for (const DiagonalBlock& block : blocks) width = std::max<Eigen::Index>(width, std::ssize(block.columns));
  return width;
}

Matrix packed(const Matrix& A, const std::vector<DiagonalBlock>& blocks) {
  Matrix P = Matrix::Zero(A.rows(), largest_width(blocks));
  for (const DiagonalBlock& block : blocks)
    P(block.rows, Eigen::seqN(0, block.columns.size())) = A(block.rows, block.columns);
  return P;
}

Matrix unpacked(const Matrix& P, const std::vector<DiagonalBlock>& blocks, Eigen::Index columns) {
  Matrix A = Matrix::Zero(P.rows(), columns);
  for (const DiagonalBlock& block : blocks)
    A(block.rows, block.columns) = P(block.rows, Eigen::seqN(0, block.columns.size()));
  return A;
}

}  // namespace eigentrail
