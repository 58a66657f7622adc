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

/// The products of one basis with all matrices, if most entries of the basis are zero and matrices are
/// sparse.
std::optional<SparseCongruence> sparse_products(const TangentBasis& basis, const Linearization& matrices) {
  const bool any = matrices.M[0].is_sparse() || matrices.C[0].is_sparse() || matrices.K[0].is_sparse();
  if (!any || basis.is_identity) return std::nullopt;
  if (!basis.left.empty()) return SparseCongruence::of(basis.left, basis.T);
  if (basis.parts) return SparseCongruence::of({basis.parts->left}, basis.T);
  return SparseCongruence::of(basis.T, basis.T);
}

MatrixSeries project(const TangentBasis& basis, const std::optional<SparseCongruence>& sparse,
                     const SystemSeries& B, int order) {
  const MatrixSeries& T = basis.T;
  if (basis.is_identity) return dense_terms(B, last_order(order, B.size(), 1) + 1);
  if (sparse && B[0].is_sparse()) return (*sparse)(B, static_cast<std::size_t>(order) + 1);
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

/// Whether a matrix only selects and scales coordinates: one entry in every column.
bool selects(const Matrix& A) {
  return ((A.array() != 0.0).colwise().count() == 1).all();
}

/// left^T B right, of which the diagonal blocks are used.
Matrix blocks_of(const IndependentParts& parts, const SystemMatrix& B) {
  // Balanced coordinates, the directions x and y of a shaft: the same numbers as below, without their n^3
  // multiplications.
  if (!B.is_sparse() && selects(parts.left) && selects(parts.right))
    return congruence(parts.left, B.dense(), parts.right);
  Matrix result = Matrix::Zero(parts.left.cols(), parts.right.cols());
  Matrix product = Matrix::Zero(B.rows(), parts.right.cols());
  B.add_product_to(product, parts.right);
  for (const IndependentParts::Range& range : parts.ranges) {
    if (range.complex_sign < 0) continue;  // has the same matrices
    const auto left = parts.left.middleCols(range.first, range.size);
    const auto columns = product.middleCols(range.first, range.size);
    auto block = result.block(range.first, range.first, range.size, range.size);
    if (B.is_sparse())
      block = transposed_product(Matrix(left), Matrix(columns));
    else
      block.noalias() = left.transpose() * columns;
  }
  return result;
}

/// left^T B right within its pattern, coefficient by coefficient up to h^order. Of what is beside the
/// diagonal blocks nothing is used.
MatrixSeries transformed(const IndependentParts& parts, const std::optional<SparseCongruence>& sparse,
                         const SystemSeries& B, const Matrix& pattern, int order) {
  const std::size_t count = last_order(order, B.size(), 1) + 1;
  MatrixSeries result(count);
  if (sparse && B[0].is_sparse()) {
    result = (*sparse)(B, count);
  } else {
    std::transform(B.begin(), B.begin() + static_cast<std::ptrdiff_t>(count), result.begin(),
                   [&](const SystemMatrix& coefficient) { return blocks_of(parts, coefficient); });
  }
  for (Matrix& coefficient : result) coefficient = coefficient.cwiseProduct(pattern);
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
MatrixSeries transformed(const TangentBasis& basis, const std::optional<SparseCongruence>& sparse,
                         const SystemSeries& B, const Matrix& pattern, int order) {
  const auto product = [&] {
    const MatrixSeries BT = times_basis(B, basis.T, last_order(order, B.size() + basis.T.size(), 2) + 1);
    const std::size_t count = last_order(order, BT.size() + basis.left.size(), 2) + 1;
    return transposed_product(basis.left, BT, count);
  };
  MatrixSeries result =
      sparse && B[0].is_sparse() ? (*sparse)(B, static_cast<std::size_t>(order) + 1) : product();
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
  const auto sparse = sparse_products(basis, linearization);
  const auto reduced = [&](const SystemSeries& B, const Matrix& pattern) {
    return canonical(basis.left.empty() ? transformed(parts, sparse, B, pattern, order)
                                        : transformed(basis, sparse, B, pattern, order),
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
  const auto sparse = sparse_products(basis, linearization);
  return {project(basis, sparse, linearization.M, order), project(basis, sparse, linearization.C, order),
          project(basis, sparse, linearization.K, order)};
}

}  // namespace eigentrail
