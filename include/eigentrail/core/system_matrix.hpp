// A coefficient matrix of the linearized equations: dense for small models and matrix families, sparse for
// large multibody models, in which every element couples only a few coordinates.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// A real matrix in dense or sparse storage. It becomes a dense one only by dense(): that of a large model
/// may not fit into memory.
template <class Real>
class BasicSystemMatrix {
 public:
  using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Column = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Sparse = Eigen::SparseMatrix<Real>;  ///< compressed column storage

  BasicSystemMatrix() = default;
  BasicSystemMatrix(Dense values) : values_(std::move(values)) {}  // NOLINT: a dense matrix is one
  BasicSystemMatrix(const Sparse& values) : values_(values) {}     // NOLINT: and so is a sparse one
  BasicSystemMatrix(Sparse&& values) { take(values); }             // NOLINT: likewise
  template <class Derived>
  BasicSystemMatrix(const Eigen::MatrixBase<Derived>& values) : values_(Dense(values)) {}  // NOLINT: likewise

  BasicSystemMatrix(const BasicSystemMatrix&) = default;
  BasicSystemMatrix& operator=(const BasicSystemMatrix&) = default;
  BasicSystemMatrix(BasicSystemMatrix&& other) noexcept { *this = std::move(other); }
  BasicSystemMatrix& operator=(BasicSystemMatrix&& other) noexcept {
    if (auto* sparse = std::get_if<Sparse>(&other.values_))
      take(*sparse);
    else
      values_ = std::move(other.values_);
    return *this;
  }
  ~BasicSystemMatrix() = default;

  bool is_sparse() const { return std::holds_alternative<Sparse>(values_); }
  const Sparse& sparse() const { return std::get<Sparse>(values_); }  ///< throws std::bad_variant_access

  /// All entries; O(n^2).
  Dense dense() const {
    return visit([](const auto& values) { return Dense(values); });
  }

  Eigen::Index rows() const {
    return visit([](const auto& values) { return values.rows(); });
  }
  Eigen::Index cols() const {
    return visit([](const auto& values) { return values.cols(); });
  }
  Eigen::Index size() const { return rows() * cols(); }

  Real operator()(Eigen::Index row, Eigen::Index column) const {
    return visit([&](const auto& values) { return Real(values.coeff(row, column)); });
  }

  bool is_zero() const {
    if (const auto* values = std::get_if<Dense>(&values_)) return values->isZero(Real(0.0));
    return (sparse().coeffs() == Real(0.0)).all();
  }
  /// Frobenius norm; 0 if the matrix is empty.
  Real norm() const {
    return visit([](const auto& values) { return values.size() == 0 ? Real(0.0) : Real(values.norm()); });
  }
  /// Largest magnitude of an entry; 0 if the matrix is empty.
  Real largest_entry() const {
    if (const auto* values = std::get_if<Dense>(&values_))
      return values->size() == 0 ? Real(0.0) : Real(values->cwiseAbs().maxCoeff());
    return sparse().nonZeros() == 0 ? Real(0.0) : Real(sparse().coeffs().cwiseAbs().maxCoeff());
  }
  /// Largest column sum of magnitudes; 0 if the matrix is empty.
  Real one_norm() const {
    return visit([](const auto& values) {
      Real largest(0.0);
      if (values.rows() == 0) return largest;
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        largest = std::max(largest, Real(values.col(j).cwiseAbs().sum()));
      return largest;
    });
  }
  /// Euclidean norms of the rows.
  Column row_norms() const {
    if (const auto* values = std::get_if<Dense>(&values_)) return values->rowwise().norm();
    Column squares = Column::Zero(rows());
    for (Eigen::Index j = 0; j < cols(); ++j)
      for_each_in_column(j, [&](Eigen::Index row, const Real& entry) { squares[row] += entry * entry; });
    return squares.cwiseSqrt();
  }

  /// Calls take(row, entry) for the entries of a column that are not zero.
  template <class Take>
  void for_each_in_column(Eigen::Index column, Take&& take) const {
    if (const auto* values = std::get_if<Dense>(&values_)) {
      for (Eigen::Index row = 0; row < values->rows(); ++row)
        if ((*values)(row, column) != Real(0.0)) take(row, (*values)(row, column));
      return;
    }
    for (typename Sparse::InnerIterator entry(sparse(), column); entry; ++entry)
      take(entry.row(), entry.value());
  }

  /// Adds B X to sum without a temporary; B is this matrix.
  void add_product_to(Dense& sum, const Dense& X) const {
    visit([&](const auto& values) { sum.noalias() += values * X; });
  }
  /// B^T x; B is this matrix.
  Column transposed_times(const Column& x) const {
    return visit([&](const auto& values) { return Column(values.transpose() * x); });
  }

  /// Adds `factor` B; both matrices must be dense or both sparse, otherwise throws std::bad_variant_access.
  void add_scaled(Real factor, const BasicSystemMatrix& B) {
    const auto add = [&](auto& values) {
      values += factor * std::get<std::decay_t<decltype(values)>>(B.values_);
    };
    std::visit(add, values_);
  }
  /// Zero matrix of the same shape and storage.
  BasicSystemMatrix zero() const {
    if (is_sparse()) return Sparse(rows(), cols());
    return Dense(Dense::Zero(rows(), cols()));
  }

  /// Calls visitor(values) with the stored matrix: a const Dense& or a const Sparse&.
  template <class Visit>
  decltype(auto) visit(Visit&& visitor) const {
    return std::visit(std::forward<Visit>(visitor), values_);
  }

 private:
  /// Eigen copies sparse matrices that it could move.
  void take(Sparse& values) {
    if (!is_sparse()) values_.template emplace<Sparse>();
    std::get<Sparse>(values_).swap(values);
  }

  std::variant<Dense, Sparse> values_;
};

/// B X.
template <class Real, class Derived>
auto operator*(const BasicSystemMatrix<Real>& B, const Eigen::MatrixBase<Derived>& X) {
  using Product = Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, Derived::ColsAtCompileTime>;
  return B.visit([&](const auto& values) { return Product(values * X); });
}

/// X B.
template <class Real, class Derived>
auto operator*(const Eigen::MatrixBase<Derived>& X, const BasicSystemMatrix<Real>& B) {
  using Product = Eigen::Matrix<typename Derived::Scalar, Derived::RowsAtCompileTime, Eigen::Dynamic>;
  return B.visit([&](const auto& values) { return Product(X * values); });
}

using SystemMatrix = BasicSystemMatrix<double>;
using SparseMatrix = SystemMatrix::Sparse;

/// Power series with such coefficients, all dense or all sparse; element k multiplies h^k, as in
/// MatrixSeries.
using SystemSeries = std::vector<SystemMatrix>;

}  // namespace eigentrail
