#include "projection/sparse_sum.hpp"

namespace eigentrail {

SparseSum::SparseSum(const std::vector<AffineTerm<SparseMatrix>>& terms, Eigen::Index n)
    : terms_(terms), n_(n) {
  if (terms.size() < 2) return;
  SparseMatrix all(n, n);
  for (const AffineTerm<SparseMatrix>& term : terms) all += term.matrix.cwiseAbs();
  starts_.assign(all.outerIndexPtr(), all.outerIndexPtr() + n + 1);
  rows_.assign(all.innerIndexPtr(), all.innerIndexPtr() + all.nonZeros());
}

SparseMatrix SparseSum::with(std::span<const double> factors) const {
  if (terms_.empty()) return SparseMatrix(n_, n_);
  if (terms_.size() == 1) return factors[0] * terms_.front().matrix;
  const std::vector<double> zeros(rows_.size(), 0.0);
  SparseMatrix sum = Eigen::Map<const SparseMatrix>(n_, n_, static_cast<Eigen::Index>(rows_.size()),
                                                    starts_.data(), rows_.data(), zeros.data());
  std::vector<int> place(static_cast<std::size_t>(n_));  // of a row within the sum's column
  for (Eigen::Index j = 0; j < n_; ++j) {
    for (int k = starts_[static_cast<std::size_t>(j)]; k < starts_[static_cast<std::size_t>(j) + 1]; ++k)
      place[static_cast<std::size_t>(rows_[static_cast<std::size_t>(k)])] = k;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      for (SparseMatrix::InnerIterator entry(terms_[i].matrix, j); entry; ++entry)
        sum.valuePtr()[place[static_cast<std::size_t>(entry.row())]] += factors[i] * entry.value();
    }
  }
  return sum;
}

}  // namespace eigentrail
