// Splitting of matrices into independent parts in suitable coordinates (see independent_parts.hpp).
#pragma once

#include <random>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

using Random = std::mt19937_64;

/// A linear combination of the matrices with normally distributed factors.
Matrix random_combination(const std::vector<Matrix>& all, Random& random);

/// Coordinates of parts in balanced coordinates: columns of `right` and `left`, part after part.
struct Splitting {
  Matrix right, left;
  std::vector<Eigen::Index> sizes;
  /// Per part, whether it belongs to a complex pair of eigenvalues of X. Then it is a complex pair of parts
  /// that no real coordinates separate, or two equal parts of which another X would tell. Only where the
  /// parts are those of one X.
  std::vector<bool> of_pair;
};

/// The parts of any matrices, all n x n and of norm one. Coordinates that no entry connects come first: they
/// are separated without rounding. `magnified`: rounding of the matrices in units of their own, >= 1.
Splitting split(const std::vector<Matrix>& all, double magnified);

/// `magnified` times the condition number of the coordinates, by which their own rounding is larger.
double magnified_by(const Splitting& splitting, double magnified);

/// Bounds of rounding in the entries of left^T A right: a share of the terms that each is the sum of.
Matrix rounding_of_entries(const Matrix& left, const Matrix& A, const Matrix& right, double magnified);

/// One where an entry of left^T A right is more than rounding for any of the matrices, else zero.
Matrix pattern_of_entries(const Matrix& left, const std::vector<Matrix>& matrices, const Matrix& right,
                          double magnified);

/// Coordinates without entries that are rounding of the largest one in their column. Computed vectors have
/// such entries in place of zeros, and nothing could tell whether they matter.
Matrix without_rounding_of_columns(Matrix coordinates);

/// Largest norm of what couples independent parts by rounding, relative to matrices of norm one in
/// coordinates of norm one.
double largest_coupling(double magnified);

}  // namespace eigentrail
