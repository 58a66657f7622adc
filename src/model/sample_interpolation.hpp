// The interpolant of sampled matrices: in pieces between kinks, each a rational interpolant whose degree and
// poles are chosen by leave-one-out errors.
#pragma once

#include <vector>

#include "eigentrail/model/sampled_data.hpp"
#include "model/rational_interpolant.hpp"

namespace eigentrail {

/// Largest degree of a blended polynomial. Higher ones amplify errors of the samples near the ends (Floater &
/// Hormann, Sect. 5).
inline constexpr int highest_degree = 15;

/// Samples `first` ... `first` + n - 1 and their interpolant.
struct SamplePiece {
  std::size_t first = 0;
  RationalInterpolant interpolant;
  /// k x n, k <= n: products of its columns are those of the samples, with the entries scaled to equal
  /// magnitude and without their mean.
  Matrix reduced;
  /// Denominators fitted to all samples but one, a denominator per sample; empty if there are no poles.
  std::vector<Denominator> without_one = {};
  /// Other degrees, without poles, that predict samples which are left out about as well.
  std::vector<int> rivals = {};
  /// The error with which it predicts samples that are left out, as a share of that of degree 1.
  double gain = 0.0;

  std::size_t size() const { return interpolant.nodes().size(); }
};

/// `values` are those of the data in the unit of the model; kinks are indices of samples, ascending.
/// `degree`: absent, degree and poles are those with the least leave-one-out error; else there are no poles.
std::vector<SamplePiece> interpolate_samples(const SampledData& data, const std::vector<double>& values,
                                             const std::vector<std::size_t>& kinks,
                                             std::optional<int> degree);

/// The piece that holds x; a kink belongs to the piece before it.
const SamplePiece& piece_at(const std::vector<SamplePiece>& pieces, double x);

/// The coefficients, one per node, of what the interpolant of the other nodes misses at node `left_out`.
Vector leave_one_out(const std::vector<double>& nodes, int degree, std::size_t left_out,
                     const Denominator& denominator = {});

}  // namespace eigentrail
