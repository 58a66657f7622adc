// Sums of entries of the matrices of the linearized equations, as power series.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "eigentrail/model/model.hpp"
#include "model/recorded_equations.hpp"

namespace eigentrail {

/// Sum of entries of a matrix whose coefficients are power series up to h^order.
template <class Real>
class MatrixSum {
 public:
  MatrixSum(Eigen::Index rows, Eigen::Index columns, int order, bool sparse)
      : rows_(rows), columns_(columns), sparse_(sparse), entries_(static_cast<std::size_t>(order) + 1) {
    if (!sparse) dense_.assign(entries_.size(), Dense::Zero(rows, columns));
  }

  /// Adds to the coefficient of h^k of an entry.
  void add(std::size_t k, int row, int column, const Real& value) {
    if (!sparse_)
      dense_[k](row, column) += value;
    else if (value != Real(0.0))
      entries_[k].emplace_back(row, column, value);
  }

  /// The sum without trailing coefficients that are exactly zero, so a constant has one coefficient. May be
  /// called once.
  typename BasicLinearization<Real>::Coefficients take() {
    typename BasicLinearization<Real>::Coefficients result;
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      if (sparse_)
        result.emplace_back(sparse_sum(k));
      else
        result.emplace_back(std::move(dense_[k]));
    }
    while (result.size() > 1 && result.back().is_zero()) result.pop_back();
    return result;
  }

 private:
  using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  using Triplets = std::vector<Eigen::Triplet<Real>>;

  Eigen::SparseMatrix<Real> sparse_sum(std::size_t k) const {
    Eigen::SparseMatrix<Real> sum(rows_, columns_);
    sum.setFromTriplets(entries_[k].begin(), entries_[k].end());
    return sum;
  }

  Eigen::Index rows_, columns_;
  bool sparse_;
  std::vector<Dense> dense_;
  std::vector<Triplets> entries_;
};

/// The sums of all four matrices of a linearization.
template <class Real>
struct LinearizationSums {
  MatrixSum<Real> M, C, K, A;

  /// For n coordinates and m constraints.
  LinearizationSums(int n, int m, int order)
      : M(n, n, order, n >= sparse_from),
        C(n, n, order, n >= sparse_from),
        K(n, n, order, n >= sparse_from),
        A(m, n, order, n >= sparse_from) {}

  BasicLinearization<Real> take() { return {M.take(), C.take(), K.take(), A.take()}; }
};

}  // namespace eigentrail
