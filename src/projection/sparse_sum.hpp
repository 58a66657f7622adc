// Sums of sparse matrices with factors, whose common pattern is found once.
#pragma once

#include <span>
#include <vector>

#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

/// sum_i f_i A_i for varying factors f_i. The matrices must outlive it.
class SparseSum {
 public:
  /// The matrices of the terms, n x n each, compressed.
  SparseSum(const std::vector<AffineTerm<SparseMatrix>>& terms, Eigen::Index n);

  /// The sum, with the pattern of all matrices together whatever the factors are, so that it is analyzed
  /// once. One factor per matrix. Cost: the number of their nonzeros.
  SparseMatrix with(std::span<const double> factors) const;

 private:
  const std::vector<AffineTerm<SparseMatrix>>& terms_;
  Eigen::Index n_;
  std::vector<int> starts_, rows_;  ///< of the columns of the sum; empty with less than two matrices
};

}  // namespace eigentrail
