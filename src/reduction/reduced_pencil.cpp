#include "eigentrail/reduction/reduced_pencil.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "core/products.hpp"
#include "eigentrail/reduction/complex_blocks.hpp"

namespace eigentrail {
namespace {

/// The highest order, at most `order`, of a product of `factors` series with `sum_of_sizes` coefficients in
/// all.
std::size_t last_order(int order, std::size_t sum_of_sizes, std::size_t factors) {
  return std::min<std::size_t>(static_cast<std::size_t>(order), sum_of_sizes - factors);
}

MatrixSeries dense_terms(const SystemSeries& B, std::size_t count) {
  MatrixSeries result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(B[i].dense());
  return result;
}

/// The first `count` coefficients of B(h) T(h).
MatrixSeries times_basis(const SystemSeries& B, const MatrixSeries& T, std::size_t count) {
  MatrixSeries product(count, Matrix::Zero(B[0].rows(), T[0].cols()));
  for (std::size_t i = 0; i < B.size(); ++i) {
    for (std::size_t j = 0; j < T.size() && i + j < count; ++j) B[i].add_product_to(product[i + j], T[j]);
  }
  return product;
}

/// left(h)^T BT(h) for BT(h) = B(h) T(h). Dense models use Eigen's products, not BLAS, so that their results
/// do not change between versions, not even in the last bit.
MatrixSeries times_left(const MatrixSeries& left, const MatrixSeries& BT, const SystemSeries& B, int order) {
  const std::size_t count = last_order(order, BT.size() + left.size(), 2) + 1;
  if (B[0].is_sparse()) return transposed_product(left, BT, count);
  MatrixSeries result(count, Matrix::Zero(left[0].cols(), BT[0].cols()));
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < BT.size() && i + j < count; ++j)
      result[i + j].noalias() += left[i].transpose() * BT[j];
  }
  return result;
}

MatrixSeries project(const TangentBasis& basis, const std::optional<SparseCongruence>& sparse,
                     const SystemSeries& B, int order) {
  if (basis.is_identity) return dense_terms(B, last_order(order, B.size(), 1) + 1);
  if (sparse) return (*sparse)(B, static_cast<std::size_t>(order) + 1);
  const std::size_t count = last_order(order, B.size() + basis.T.size(), 2) + 1;
  return times_left(basis.T, times_basis(B, basis.T, count), B, order);
}

using Columns = std::vector<Eigen::Index>;

MatrixSeries columns_of(const MatrixSeries& A, const Columns& columns) {
  MatrixSeries result;
  for (const Matrix& coefficient : A) result.emplace_back(coefficient(Eigen::all, columns));
  return result;
}

/// The blocks left(h)^T B(h) right(h) of all parts, for several B. Parts most of whose coordinates and
/// equations are zero are reduced together, as sparse matrices, and the others together, as dense ones.
class PartProducts {
 public:
  explicit PartProducts(const TangentBasis& basis)
      : basis_(basis), left_(basis.left.empty() ? MatrixSeries{basis.parts->left} : basis.left) {
    for (const IndependentParts::Range& range : basis.parts->ranges) {
      if (range.complex_sign < 0) continue;  // has the same matrices
      Columns columns(static_cast<std::size_t>(range.size));
      std::iota(columns.begin(), columns.end(), range.first);
      const bool few =
          is_mostly_zero(columns_of(left_, columns)) && is_mostly_zero(columns_of(basis.T, columns));
      (few ? sparse_ : dense_).push_back(columns);
    }
    const Columns together = joined(sparse_);
    if (!sparse_.empty())
      product_ = SparseCongruence::of(columns_of(left_, together), columns_of(basis.T, together));
    dense_right_ = columns_of(basis.T, joined(dense_));
  }

  /// Within a pattern. Where the basis changes along the path, it tells the freedoms that no force holds.
  MatrixSeries operator()(const SystemSeries& B, const Matrix& pattern, int order) const {
    const std::size_t count = last_order(order, B.size() + basis_.T.size() + left_.size(), 3) + 1;
    MatrixSeries result(count, Matrix::Zero(pattern.rows(), pattern.cols()));
    const auto place = [&](const MatrixSeries& all, Eigen::Index first, const Columns& part) {
      const Eigen::Index at = part.front(), size = std::ssize(part);
      const bool within = basis_.left.empty() || size == 1;
      for (std::size_t k = 0; k < all.size(); ++k) {
        auto block = result[k].block(at, at, size, size);
        block = all[k].block(first, first, size, size);
        if (within) block.array() *= pattern.block(at, at, size, size).array();
      }
    };
    Eigen::Index first = 0;
    if (!sparse_.empty()) {
      const MatrixSeries all = (*product_)(B, count);
      for (const Columns& part : sparse_) place(all, std::exchange(first, first + std::ssize(part)), part);
    }
    if (dense_.empty()) return result;
    const std::size_t count_BT = last_order(order, B.size() + basis_.T.size(), 2) + 1;
    const MatrixSeries BT = times_basis(B, dense_right_, count_BT);
    first = 0;
    for (const Columns& part : dense_) {
      MatrixSeries own;
      for (const Matrix& all : BT) own.emplace_back(all.middleCols(first, std::ssize(part)));
      first += std::ssize(part);
      place(times_left(columns_of(left_, part), own, B, order), 0, part);
    }
    return result;
  }

 private:
  static Columns joined(const std::vector<Columns>& parts) {
    Columns all;
    for (const Columns& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  const TangentBasis& basis_;
  MatrixSeries left_;
  std::vector<Columns> sparse_, dense_;  ///< of each part
  std::optional<SparseCongruence> product_;
  MatrixSeries dense_right_;
};

/// The diagonal block of a part.
MatrixSeries block_of(const MatrixSeries& B, const IndependentParts::Range& range) {
  MatrixSeries result;
  for (const Matrix& coefficient : B)
    result.emplace_back(coefficient.block(range.first, range.first, range.size, range.size));
  while (result.size() > 1 && result.back().isZero(0.0)) result.pop_back();
  return result;
}

/// Removes the rounding by which conjugate pairs of parts differ from their canonical form.
MatrixSeries canonical(MatrixSeries B, const IndependentParts& parts) {
  for (const IndependentParts::Range& range : parts.ranges) {
    if (range.complex_sign <= 0) continue;
    for (Matrix& coefficient : B) {
      auto block = coefficient.block(range.first, range.first, range.size, range.size);
      block = canonical_form(block);
    }
  }
  return B;
}

ReducedPencil reduce_parts(const Linearization& linearization, const TangentBasis& basis, int order) {
  const IndependentParts& parts = *basis.parts;
  const PartProducts products(basis);
  const auto reduced = [&](const SystemSeries& B, const Matrix& pattern) {
    return canonical(products(B, pattern, order), parts);
  };
  ReducedPencil whole{reduced(linearization.M, parts.pattern_M), reduced(linearization.C, parts.pattern_C),
                      reduced(linearization.K, parts.pattern_K)};
  const auto copies = [](const IndependentParts::Range& range) {
    return static_cast<int>(range.copies.size());
  };
  if (parts.count() == 1) {
    whole.copies = copies(parts.ranges.front());
    return whole;
  }
  for (const IndependentParts::Range& range : parts.ranges)
    whole.parts.push_back({block_of(whole.M, range),
                           block_of(whole.C, range),
                           block_of(whole.K, range),
                           {},
                           copies(range),
                           range.complex_sign});
  return whole;
}

}  // namespace

ReducedPencil reduce(const Linearization& linearization, const TangentBasis& basis, int order) {
  if (basis.parts) return reduce_parts(linearization, basis, order);
  const auto sparse = basis.is_identity ? std::nullopt : SparseCongruence::of(basis.T, basis.T);
  return {project(basis, sparse, linearization.M, order), project(basis, sparse, linearization.C, order),
          project(basis, sparse, linearization.K, order)};
}

}  // namespace eigentrail
