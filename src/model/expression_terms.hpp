// The summands of matrices whose entries are expressions of parameters.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "eigentrail/model/affine_family.hpp"

namespace eigentrail {

using DenseTerms = std::vector<AffineTerm<Matrix>>;

/// The terms of the entries of one matrix that are expressions. Entries of one expression have a term in
/// common, and so have entries across the diagonal that are equal up to the sign: the symmetry of the matrix
/// is that of its terms.
class ExpressionTerms {
 public:
  ExpressionTerms(Eigen::Index rows, Eigen::Index columns, const Parameters& parameters);

  void add(Eigen::Index row, Eigen::Index column, const Expression& entry);
  /// The terms, each multiplied by a power of the variable. May be called once.
  DenseTerms take(const Expression& power);

 private:
  /// The term to which an entry belongs, and its sign there.
  std::pair<std::size_t, double> place_of(Eigen::Index row, Eigen::Index column, const Expression& entry);

  Eigen::Index rows_, columns_;
  std::vector<Vector> places_;  ///< values of the parameters at which expressions are compared
  DenseTerms terms_;
  std::map<std::pair<Eigen::Index, Eigen::Index>, std::size_t> term_at_;
};

}  // namespace eigentrail
