// The interpolant of sampled matrices: in pieces between kinks, each a rational interpolant whose degree is
// chosen by leave-one-out errors.
#pragma once

#include <vector>

#include "eigentrail/model/sampled_data.hpp"
#include "model/rational_interpolant.hpp"

namespace eigentrail {

/// Samples `first` ... `first` + n - 1 and their interpolant.
struct SamplePiece {
  std::size_t first = 0;
  RationalInterpolant interpolant;
  /// k x n, k <= n: products of its columns are those of the samples, with the entries scaled to equal
  /// magnitude and without their mean.
  Matrix reduced;

  std::size_t size() const { return interpolant.nodes().size(); }
};

/// `values` are those of the data in the unit of the model; kinks are indices of samples, ascending.
/// `degree`: absent, the one with the least leave-one-out error.
std::vector<SamplePiece> interpolate_samples(const SampledData& data, const std::vector<double>& values,
                                             const std::vector<std::size_t>& kinks,
                                             std::optional<int> degree);

/// The piece that holds x; a kink belongs to the piece before it.
const SamplePiece& piece_at(const std::vector<SamplePiece>& pieces, double x);

/// For each degree from 1, the error with which the interpolant of all samples but one misses that one, in
/// the norm of the reduced samples, over all samples but the first and the last. At least four nodes.
std::vector<double> leave_one_out_errors(const std::vector<double>& nodes, const Matrix& reduced);

/// The coefficients, one per node, of what the interpolant of the other nodes misses at node `left_out`.
Vector leave_one_out(const std::vector<double>& nodes, int degree, std::size_t left_out);

}  // namespace eigentrail
