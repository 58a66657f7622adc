// Collects the entries of sparse matrices that are sums of constant matrices with factors.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

/// One of the matrices M, C and K as it is put together. What has the same factor is one matrix.
class MatrixSum {
 public:
  /// Adds `factor` * `value` at a row and a column; nothing where one of them is negative (a freedom that is
  /// held) or the value is zero. Constant factors are multiplied into the value. If there is a table, its
  /// function of `factor` takes the place of the factor.
  void add(Eigen::Index row, Eigen::Index column, const Expression& factor, double value = 1.0,
           const std::shared_ptr<const TabulatedFactor>& table = nullptr);
  /// Adds `factor` * `entry` * `value`; constant entries are multiplied into the value.
  void add_product(Eigen::Index row, Eigen::Index column, const Expression& factor, const Expression& entry,
                   double value);

  /// Adds all entries of another sum, times `strength`.
  void add(const MatrixSum& other, const Expression& strength);

  bool empty() const { return parts_.empty(); }

  /// The summands, n x n.
  std::vector<AffineTerm<SparseMatrix>> terms(Eigen::Index n) const;

 private:
  struct Part {
    Expression factor;
    std::shared_ptr<const TabulatedFactor> table;
    Expression scale = 1.0;  ///< of the tabulated function
    std::map<std::pair<Eigen::Index, Eigen::Index>, double> entries = {};
  };

  Part& part(const Expression& factor, const std::shared_ptr<const TabulatedFactor>& table,
             const Expression& scale = 1.0);

  std::vector<Part> parts_;
};

/// M, C and K.
struct PencilSum {
  MatrixSum M, C, K;
};

}  // namespace eigentrail
