// Errors of eigenvalues that come from samples: what the interpolant misses between them, and the digits to
// which their entries are known.
//
// To first order an eigenvalue s with eigenvectors y, z of P(s) = s^2 M + s C + K moves by
//
//   ds = - y^H dP(s) z / (y^H P'(s) z)                        (Tisseur, Lin. Alg. Appl. 309, 2000, Sect. 2)
//
// so the error of the interpolant needs no bound for matrices: each sample counts with the number
// g_j = y^H P_j(s) z / (y^H P'(s) z), and the error of the interpolant of these numbers is that of s.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct SamplePiece;

/// Samples of a coefficient of s^2 M + s C + K.
struct PencilSamples {
  int power = 0;                ///< of s
  std::vector<Matrix> samples;  ///< one per value of the parameter, or a single one if all are the same
  /// Bounds of the errors of the entries; like `samples`, or empty: the entries are exact.
  std::vector<Matrix> entry_errors = {};

  bool is_constant() const { return samples.size() == 1; }
  const Matrix& at(std::size_t i) const { return samples[is_constant() ? 0 : i]; }
  const Matrix& errors_at(std::size_t i) const { return entry_errors[is_constant() ? 0 : i]; }
};

/// An eigenvalue with its right and left eigenvector, P(s) z = 0 and y^H P(s) = 0, scaled to y^H P'(s) z = 1.
struct EigenTriple {
  Complex s;
  ComplexVector right, left;
};

/// Bounds of the error of eigenvalues between two samples, absolute, 1/s; an entry per eigenvalue.
struct SampleBounds {
  Vector smooth;  ///< what the interpolant misses at most; it vanishes at the samples (SampleErrors::shape)
  Vector rough;   ///< of errors of the samples that do not depend smoothly on the parameter, and of rounding
  Vector digits;  ///< of the digits of the samples
  Vector smooth_growth, rough_growth;  ///< the first two of Re s: an error may be nearly all in Im s

  /// The bound of what is interpolated, where the smooth part has this share of its largest value.
  Vector interpolation(double shape = 1.0) const { return (shape * smooth).cwiseMax(rough); }
  Vector growth(double shape = 1.0) const { return (shape * smooth_growth).cwiseMax(rough_growth); }
};

/// How the error between two samples is estimated. The numbers were calibrated on families in closed form
/// (docs/developers/accuracy.md, Errors of samples); a test varies each by three.
struct SampleErrorOptions {
  /// Interpolants of one degree more and less differ by about the error; it is multiplied by this.
  double safety = 3.4;
  /// Largest ratio of the errors of successive degrees with which that difference is extrapolated.
  double slowest = .8;
  /// A degree more is worth it if it brings the leave-one-out errors beside a gap down by this factor.
  double worth_a_degree = 1.5;
  /// Where leave-one-out errors are not below this share of those of degree 1, there may be kinks, and
  /// one-sided lines differ from the interpolant by about its error; that is multiplied by the second number.
  double may_have_kinks = 0.25;
  double beside_a_kink = 3.0;
  /// Factor for the gaps at the ends of the range, which have samples on one side only.
  double at_an_end = 2.0;
  /// Factor of the leave-one-out errors of the neighbouring samples, whose gaps are twice as wide.
  double leave_one_out = 10.0;
  /// Errors of samples that do not depend smoothly on the parameter count with this factor times their
  /// standard deviation on the whole range,
  double deviations = 5.0;
  /// or, if that is less, with this factor times the root mean square of leave-one-out errors nearby.
  double deviations_nearby = 4.0;
};

/// Errors of eigenvalues on the range of samples of one parameter.
class SampleErrors {
 public:
  SampleErrors() = default;
  virtual ~SampleErrors() = default;
  SampleErrors(const SampleErrors&) = delete;
  SampleErrors& operator=(const SampleErrors&) = delete;

  static constexpr int no_parameter = -1;

  /// Index of the parameter, or no_parameter; while another one is traced, nothing is known.
  virtual int parameter() const = 0;

  /// Values of the samples, ascending, in the SI unit of the parameter.
  virtual const std::vector<double>& values() const = 0;

  /// Bounds that hold between the samples `gap` and `gap` + 1, or at the only sample, for eigenvalues with
  /// the given eigenvectors. Cost: a product of n x n and n x k per sample, k the number of eigenvalues.
  virtual SampleBounds between(std::size_t gap, std::span<const EigenTriple> triples) const = 0;

  /// The smooth error at x (SI unit) as a share of its largest value between the two samples beside it, if
  /// the derivatives of the function vary little there: zero at a sample.
  virtual double shape(double x) const = 0;

  /// The place between the samples `gap` and `gap` + 1, cut to `from` ... `to`, where the error of the
  /// interpolant is largest for a function whose derivatives vary little.
  virtual double place_of_largest_error(std::size_t gap, double from, double to) const = 0;
};

/// Those of samples of all matrices at the same values. Refers to samples and pieces, which must outlive it.
class InterpolationErrors final : public SampleErrors {
 public:
  InterpolationErrors(int parameter, const std::vector<double>& values,
                      const std::array<PencilSamples, 3>& samples, const std::vector<SamplePiece>& pieces,
                      SampleErrorOptions options = {});

  int parameter() const override { return parameter_; }
  const std::vector<double>& values() const override { return values_; }
  SampleBounds between(std::size_t gap, std::span<const EigenTriple> triples) const override;
  double shape(double x) const override;
  double place_of_largest_error(std::size_t gap, double from, double to) const override;

 private:
  int parameter_;
  const std::vector<double>& values_;
  const std::array<PencilSamples, 3>& samples_;
  const std::vector<SamplePiece>& pieces_;
  SampleErrorOptions options_;
  /// Per piece and coefficient: variances of the entries' errors that are not smooth; empty if there are
  /// none.
  std::vector<std::array<Matrix, 3>> variances_;
};

}  // namespace eigentrail
