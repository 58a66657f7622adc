// Blocks into which a matrix falls when its rows and columns are reordered. Constraints of a body that has no
// others in common with its neighbours are such a block, and so are the motions that they allow.
#pragma once

#include <vector>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// Rows and columns that share no entry with any others, in ascending order.
struct DiagonalBlock {
  std::vector<Eigen::Index> rows, columns;
};

/// The blocks of a matrix, in the order of their first columns. A column without entries is a block without
/// rows; a row without entries is in no block. Explicit zeros are entries. Cost: O(entries).
std::vector<DiagonalBlock> diagonal_blocks(const SparseMatrix& A);

/// The same of the entries that are not zero in some of the matrices, all of one size.
std::vector<DiagonalBlock> diagonal_blocks(const MatrixSeries& all);

/// The number of columns of the largest block.
Eigen::Index largest_width(const std::vector<DiagonalBlock>& blocks);

/// The columns of the blocks of a matrix side by side, in as few columns as the largest block has: what acts
/// on every block by itself acts on all of them at once.
Matrix packed(const Matrix& A, const std::vector<DiagonalBlock>& blocks);

/// The matrix with so many columns of which P = packed(A, blocks).
Matrix unpacked(const Matrix& P, const std::vector<DiagonalBlock>& blocks, Eigen::Index columns);

}  // namespace eigentrail
