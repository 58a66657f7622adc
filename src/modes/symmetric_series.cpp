// Power series of all pairs of an undamped symmetric pencil, in modal coordinates.
#include "core/products.hpp"
#include "eigentrail/modes/symmetric_pairs.hpp"
#include "modes/real_blocks.hpp"

namespace eigentrail {
namespace {

/// X^T B_i X for the coefficients i >= 1; empty matrices if B_i is zero.
std::vector<Matrix> in_modes(const MatrixSeries& B, const Matrix& X, std::size_t count) {
  std::vector<Matrix> result(count);
  for (std::size_t i = 1; i < count && i < B.size(); ++i) {
    if (!B[i].isZero(0.0)) result[i] = transposed_product(X, product(B[i], X));
  }
  return result;
}

/// Coefficients E_j of X(h) = X E(h), L_j of the blocks and N_j of N(h) = X^T M(h) X E(h), computed order by
/// order. E_j is zero within the blocks for j > 0: the pairs are normalized afterwards.
class ModalSeries {
 public:
  ModalSeries(const ReducedPencil& pencil, const SymmetricPairs& pairs, std::size_t count)
      : pairs_(pairs),
        divisors_(pairs.divisors()),
        M_(in_modes(pencil.M, pairs.X, count)),
        K_(in_modes(pencil.K, pairs.X, count)),
        E_{Matrix::Identity(pairs.X.cols(), pairs.X.cols())},
        N_{E_[0]},
        L_{pairs.lambda.asDiagonal()} {
    for (std::size_t j = 1; j < count; ++j) append(j);
  }

  /// Coefficient j of all vectors, n x n.
  Matrix vectors(std::size_t j) const { return j == 0 ? pairs_.X : product(pairs_.X, E_[j]); }

  Matrix of_block(const SymmetricPairs::Block& block, std::size_t j) const {
    return L_[j].block(block.first, block.first, block.size, block.size);
  }

 private:
  void append(std::size_t j) {
    const Matrix inertia = sum_of(M_, j);
    Matrix known = sum_of(K_, j) + inertia * pairs_.lambda.asDiagonal();
    Matrix L = Matrix::Zero(known.rows(), known.cols());
    for (const SymmetricPairs::Block& block : pairs_.blocks) {
      auto columns = known.middleCols(block.first, block.size);
      for (std::size_t i = 1; i < j; ++i)
        columns += N_[j - i].middleCols(block.first, block.size) * of_block(block, i);
      L.block(block.first, block.first, block.size, block.size) =
          -columns.middleRows(block.first, block.size);
    }
    E_.emplace_back(known.cwiseProduct(divisors_));
    N_.emplace_back(E_[j] + inertia);
    L_.push_back(std::move(L));
  }

  /// Coefficient j of B(h) E(h) without the term B_0 E_j.
  Matrix sum_of(const std::vector<Matrix>& B, std::size_t j) const {
    Matrix sum = j < B.size() && B[j].size() > 0 ? B[j] : Matrix(Matrix::Zero(E_[0].rows(), E_[0].cols()));
    for (std::size_t i = 1; i < j; ++i) {
      if (B[i].size() > 0) sum += product(B[i], E_[j - i]);
    }
    return sum;
  }

  const SymmetricPairs& pairs_;
  Matrix divisors_;
  std::vector<Matrix> M_, K_, E_, N_, L_;
};

}  // namespace

std::vector<PairSeries> differentiate_symmetric(const ReducedPencil& pencil, const SymmetricPairs& pairs,
                                                int order, ModeCounts& counts) {
  const auto count = static_cast<std::size_t>(order) + 1;
  const ModalSeries series(pencil, pairs, count);
  counts.modal_solves += count - 1;
  std::vector<Matrix> X;
  for (std::size_t j = 0; j < count; ++j) X.push_back(series.vectors(j));
  std::vector<PairSeries> result;
  for (const SymmetricPairs::Pair& pair : pairs.pairs) {
    const SymmetricPairs::Block& block = pairs.blocks[pair.block];
    RealSeries modes;
    for (std::size_t j = 0; j < count; ++j) {
      modes.X.emplace_back(X[j].middleCols(block.first, block.size));
      modes.L.push_back(series.of_block(block, j));
    }
    result.push_back(pair_series(pair.root, modes, pair.W));
  }
  return result;
}

}  // namespace eigentrail
