#include "eigentrail/reduction/reduced_pencil.hpp"

#include <algorithm>

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

}  // namespace

MatrixSeries project(const TangentBasis& basis, const SystemSeries& B, int order) {
  const MatrixSeries& T = basis.T;
  if (basis.is_identity) return dense_terms(B, last_order(order, B.size(), 1) + 1);
  if (auto sparse = sparse_congruence(T, B, T, static_cast<std::size_t>(order) + 1)) return *sparse;
  const MatrixSeries BT = times_basis(B, T, last_order(order, B.size() + T.size(), 2) + 1);
  const std::size_t count = last_order(order, BT.size() + T.size(), 2) + 1;
  // Dense models use Eigen's products, not BLAS, so that their results do not change between versions, not
  // even in the last bit.
  if (B[0].is_sparse()) return transposed_product(T, BT, count);
  MatrixSeries result(count, Matrix::Zero(T[0].cols(), T[0].cols()));
  for (std::size_t i = 0; i < T.size(); ++i) {
    for (std::size_t j = 0; j < BT.size() && i + j < result.size(); ++j) {
      result[i + j].noalias() += T[i].transpose() * BT[j];
    }
  }
  return result;
}

namespace {

/// The rows of the only entries of every column; empty if a column has not one entry.
std::vector<Eigen::Index> only_entries(const Matrix& A) {
  std::vector<Eigen::Index> rows;
  for (const auto& column : A.colwise()) {
    Eigen::Index row = 0;
    column.cwiseAbs().maxCoeff(&row);
    if ((column.array() != 0.0).count() != 1) return {};
    rows.push_back(row);
  }
  return rows;
}

/// The diagonal blocks of left^T B right where both select coordinates: the directions x and y of a shaft.
/// The same numbers as the products, without their n^3 multiplications.
Matrix selected_blocks(const IndependentParts& parts, const Matrix& B, const std::vector<Eigen::Index>& rows,
                       const std::vector<Eigen::Index>& columns) {
  Matrix result = Matrix::Zero(parts.left.cols(), parts.right.cols());
  for (const IndependentParts::Range& range : parts.ranges) {
    if (range.complex_sign < 0) continue;  // has the same matrices
    for (Eigen::Index j = range.first; j < range.first + range.size; ++j) {
      const Eigen::Index column = columns[static_cast<std::size_t>(j)];
      for (Eigen::Index i = range.first; i < range.first + range.size; ++i) {
        const Eigen::Index row = rows[static_cast<std::size_t>(i)];
        result(i, j) = parts.left(row, i) * (B(row, column) * parts.right(column, j));
      }
    }
  }
  return result;
}

/// The diagonal blocks of left^T B right.
Matrix blocks_of(const IndependentParts& parts, const SystemMatrix& B) {
  if (!B.is_sparse()) {
    const std::vector<Eigen::Index> rows = only_entries(parts.left), columns = only_entries(parts.right);
    if (!rows.empty() && !columns.empty()) return selected_blocks(parts, B.dense(), rows, columns);
  }
  Matrix result = Matrix::Zero(parts.left.cols(), parts.right.cols());
  Matrix product = Matrix::Zero(B.rows(), parts.right.cols());
  B.add_product_to(product, parts.right);
  for (const IndependentParts::Range& range : parts.ranges) {
    if (range.complex_sign < 0) continue;  // has the same matrices
    result.block(range.first, range.first, range.size, range.size).noalias() =
        parts.left.middleCols(range.first, range.size).transpose() *
        product.middleCols(range.first, range.size);
  }
  return result;
}

/// left^T B right within its pattern, coefficient by coefficient up to h^order. Of what is beside the
/// diagonal blocks nothing is used.
MatrixSeries transformed(const IndependentParts& parts, const SystemSeries& B, const Matrix& pattern,
                         int order) {
  const std::size_t count = last_order(order, B.size(), 1) + 1;
  MatrixSeries result(count);
  if (parts.is_diagonal) {
    for (std::size_t k = 0; k < count; ++k)
      result[k] = parts.left.diagonal().asDiagonal() * B[k].dense() * parts.right.diagonal().asDiagonal();
    return result;
  }
  std::optional<MatrixSeries> sparse;
  if (B[0].is_sparse()) sparse = sparse_congruence({parts.left}, B, {parts.right}, count);
  for (std::size_t k = 0; k < count; ++k)
    result[k] = (sparse ? (*sparse)[k] : blocks_of(parts, B[k])).cwiseProduct(pattern);
  return result;
}

/// The diagonal block of a part.
MatrixSeries block_of(const MatrixSeries& B, const IndependentParts::Range& range) {
  MatrixSeries result;
  for (const Matrix& coefficient : B)
    result.emplace_back(coefficient.block(range.first, range.first, range.size, range.size));
  while (result.size() > 1 && result.back().isZero(0.0)) result.pop_back();
  return result;
}

/// The same where the basis changes along the path: left(h)^T B(h) right(h), of which the diagonal blocks are
/// used. Freedoms that no force holds stay without force.
MatrixSeries transformed(const TangentBasis& basis, const SystemSeries& B, const Matrix& pattern, int order) {
  const auto product = [&] {
    const MatrixSeries BT = times_basis(B, basis.T, last_order(order, B.size() + basis.T.size(), 2) + 1);
    const std::size_t count = last_order(order, BT.size() + basis.left.size(), 2) + 1;
    return transposed_product(basis.left, BT, count);
  };
  auto sparse = sparse_congruence(basis.left, B, basis.T, static_cast<std::size_t>(order) + 1);
  MatrixSeries result = sparse ? *std::move(sparse) : product();
  for (const IndependentParts::Range& range : basis.parts->ranges) {
    if (range.size > 1) continue;
    for (Matrix& coefficient : result)
      coefficient(range.first, range.first) *= pattern(range.first, range.first);
  }
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
  const auto reduced = [&](const SystemSeries& B, const Matrix& pattern) {
    return canonical(
        basis.left.empty() ? transformed(parts, B, pattern, order) : transformed(basis, B, pattern, order),
        parts);
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
  return {project(basis, linearization.M, order), project(basis, linearization.C, order),
          project(basis, linearization.K, order)};
}

}  // namespace eigentrail
