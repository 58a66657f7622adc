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

/// Errors with which interpolants of successive degrees predict samples that are left out.
struct LeftOutErrors {
  int lowest = 1;  ///< degree of the first row
  Matrix
      norms;  ///< degrees x samples, in the norm of SamplePiece::reduced; zero at the first and last sample

  /// The error over `count` samples from `first` on, per degree.
  Vector over(std::size_t first, std::size_t count) const;
};

/// The error of degree i that may be small by chance: that of the degree above or below, if both are larger.
double credible_error(const Vector& errors, Eigen::Index i);

/// Samples `first` ... `first` + n - 1 and their interpolant.
struct SamplePiece {
  std::size_t first = 0;
  RationalInterpolant interpolant;
  /// k x n, k <= n: products of its columns are those of the samples, with the entries scaled to equal
  /// magnitude and without their mean.
  Matrix reduced;
  /// Denominators fitted to all samples but one, a denominator per sample; empty if there are no poles.
  std::vector<Denominator> without_one = {};
  /// Of polynomials, and of interpolants with as many poles as the one that is used; empty with fewer than
  /// four samples, or if the degree was given.
  LeftOutErrors polynomials = {}, alike = {};

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
