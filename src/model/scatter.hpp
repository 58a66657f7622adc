// Sums the contributions of elements to the matrices of the linearized equations.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "eigentrail/core/series.hpp"
#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// Number of coordinates from which matrices are sparse. For chains of rods, sparse and dense matrices take
/// the same time at about 80 coordinates (docs/developers/performance.md). Below the limit, matrices are
/// dense so that results do not change between versions, not even in the last bit.
inline constexpr int sparse_from = 100;

/// Sum of entries of a matrix whose coefficients are power series of order Q.
template <class Real, int Q>
class Scatter {
 public:
  using Coefficients = typename BasicLinearization<Real>::Coefficients;

  Scatter(Eigen::Index rows, Eigen::Index columns, bool sparse)
      : rows_(rows), columns_(columns), sparse_(sparse) {
    if (!sparse) dense_.fill(Dense::Zero(rows, columns));
  }

  bool is_sparse() const { return sparse_; }

  /// Adds a series to an entry.
  void add(int row, int column, const Series<Real, Q>& value) {
    for (int k = 0; k <= Q; ++k) {
      if (!sparse_)
        dense_[k](row, column) += value[k];
      else if (value[k] != Real(0.0))
        entries_[k].emplace_back(row, column, value[k]);
    }
  }

  /// Adds to the coefficient of h^k of an entry.
  void add(int k, int row, int column, const Real& value) {
    const auto at = static_cast<std::size_t>(k);
    if (!sparse_)
      dense_[at](row, column) += value;
    else if (value != Real(0.0))
      entries_[at].emplace_back(row, column, value);
  }

  /// The sum without trailing coefficients that are exactly zero, so a constant has one coefficient. May be
  /// called once.
  Coefficients take() {
    Coefficients result;
    for (int k = 0; k <= Q; ++k) {
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

  Eigen::SparseMatrix<Real> sparse_sum(int k) const {
    Eigen::SparseMatrix<Real> sum(rows_, columns_);
    sum.setFromTriplets(entries_[k].begin(), entries_[k].end());
    return sum;
  }

  Eigen::Index rows_, columns_;
  bool sparse_;
  std::array<Dense, Q + 1> dense_;
  std::array<Triplets, Q + 1> entries_;
};

/// The sums of all four matrices of a linearization.
template <class Real, int Q>
struct LinearizationScatter {
  Scatter<Real, Q> M, C, K, A;

  /// For n coordinates and m constraints.
  LinearizationScatter(int n, int m)
      : M(n, n, n >= sparse_from),
        C(n, n, n >= sparse_from),
        K(n, n, n >= sparse_from),
        A(m, n, n >= sparse_from) {}

  BasicLinearization<Real> take() { return {M.take(), C.take(), K.take(), A.take()}; }
};

}  // namespace eigentrail
