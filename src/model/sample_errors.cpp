#include "eigentrail/model/sample_errors.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/gaps.hpp"
#include "core/orthonormal.hpp"
#include "core/singular_vectors.hpp"
#include "model/gap_estimators.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {
namespace {

/// A few roundings of double precision, relative to each entry.
constexpr double rounding = 4e-16;
/// With fewer samples more than the degree, the leave-one-out errors of all samples are alike.
constexpr Eigen::Index fewest_for_noise_nearby = 7;
/// Fewest samples of a piece whose errors are split in a smooth part and the rest.
constexpr std::size_t fewest_for_noise = 6;

/// Polynomials of degree 0 ... n - 1 that are orthonormal on the nodes; column k has degree k.
Matrix orthonormal_polynomials(const std::vector<double>& nodes) {
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Matrix legendre = Matrix::Ones(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double from = nodes.front();
    const double x = 2.0 * (nodes[static_cast<std::size_t>(i)] - from) / (nodes.back() - from) - 1.0;
    if (n > 1) legendre(i, 1) = x;
    for (Eigen::Index k = 2; k < n; ++k) {
      const auto degree = static_cast<double>(k);
      legendre(i, k) =
          ((2.0 * degree - 1.0) * x * legendre(i, k - 1) - (degree - 1.0) * legendre(i, k - 2)) / degree;
    }
  }
  return whole_Q(Eigen::HouseholderQR<Matrix>(legendre));
}

/// The same, multiplied by the denominator of the interpolant and of unit length: factors of the samples that
/// give the coefficients of q f.
Matrix products_with_polynomials(const RationalInterpolant& interpolant) {
  Matrix result = orthonormal_polynomials(interpolant.nodes());
  if (interpolant.denominator().degree() == 0) return result;
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    result.row(i) *= interpolant.denominator()(interpolant.nodes()[static_cast<std::size_t>(i)]);
  return result.colwise().normalized();
}

/// Combinations of the samples, one per column, in which smooth functions of the parameter vanish: the
/// coefficients of the highest orthonormal polynomials, less their part in the main directions of the lower
/// ones. What depends smoothly on the parameter varies in few directions, and those are the same in all
/// coefficients.
struct RoughPart {
  Matrix combinations;   ///< samples x k
  double freedom = 1.0;  ///< share of the variance that is left
};

RoughPart rough_part(const SamplePiece& piece, Eigen::Index n_entries) {
  const auto n = static_cast<Eigen::Index>(piece.size());
  // One entry alone has no others that show what is smooth; its highest coefficients are so least.
  const Eigen::Index high = n_entries == 1 ? 2 : std::max<Eigen::Index>(2, n / 4);
  const Matrix polynomials = products_with_polynomials(piece.interpolant);
  const Matrix coefficients = piece.reduced * polynomials;
  const SingularVectors<Matrix> lower = singular_vectors(Matrix(coefficients.leftCols(n - high)));
  constexpr double same_direction = 1e-13;
  const Eigen::Index rank = (lower.values.array() > same_direction * lower.values[0]).count();
  // With more directions than half of the coefficients, those of errors that are not smooth are among them;
  // as many as there are entries leave nothing.
  const Eigen::Index main = std::min({(n - high) / 2, rank, n_entries - 1});
  const Matrix part = lower.V.leftCols(main) * lower.values.head(main).cwiseInverse().asDiagonal() *
                      lower.U.leftCols(main).transpose() * coefficients.rightCols(high);
  return {polynomials.rightCols(high) - polynomials.leftCols(n - high) * part,
          1.0 - static_cast<double>(main) / static_cast<double>(n_entries)};
}

bool varies(const PencilSamples& samples, const SamplePiece& piece, Eigen::Index row, Eigen::Index column) {
  const double first = samples.at(piece.first)(row, column);
  for (std::size_t i = 1; i < piece.size(); ++i) {
    if (samples.at(piece.first + i)(row, column) != first) return true;
  }
  return false;
}

Eigen::Index varying_entries(const PencilSamples& samples, const SamplePiece& piece) {
  if (samples.is_constant()) return 0;
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < samples.at(0).cols(); ++j) {
    for (Eigen::Index i = 0; i < samples.at(0).rows(); ++i) count += varies(samples, piece, i, j) ? 1 : 0;
  }
  return count;
}

double median(std::vector<double> list) {
  if (list.empty()) return 0.0;
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
  std::nth_element(list.begin(), middle, list.end());
  return *middle;
}

/// Variances of the entries of one coefficient. An entry has few coefficients of its own, so its variance is
/// averaged with one that is the same share of each entry.
Matrix entry_variances(const PencilSamples& samples, const SamplePiece& piece, const RoughPart& rough) {
  if (samples.is_constant()) return {};
  const Matrix& first = samples.at(piece.first);
  const auto own = static_cast<double>(rough.combinations.cols());
  Matrix variances = Matrix::Zero(first.rows(), first.cols());
  Matrix squares = variances, mean = variances;
  for (std::size_t i = 0; i < piece.size(); ++i)
    mean += samples.at(piece.first + i) / static_cast<double>(piece.size());
  for (Eigen::Index k = 0; k < rough.combinations.cols(); ++k) {
    Matrix rest = Matrix::Zero(first.rows(), first.cols());
    for (std::size_t i = 0; i < piece.size(); ++i)
      rest += rough.combinations(static_cast<Eigen::Index>(i), k) * (samples.at(piece.first + i) - mean);
    variances += rest.cwiseAbs2() / (own * rough.freedom);
  }
  for (std::size_t i = 0; i < piece.size(); ++i)
    squares += samples.at(piece.first + i).cwiseAbs2() / static_cast<double>(piece.size());
  std::vector<double> shares;
  for (Eigen::Index j = 0; j < first.cols(); ++j) {
    for (Eigen::Index i = 0; i < first.rows(); ++i) {
      if (!varies(samples, piece, i, j)) {
        variances(i, j) = squares(i, j) = 0.0;
      } else if (squares(i, j) > 0.0) {
        shares.push_back(variances(i, j) / squares(i, j));
      }
    }
  }
  // The median of the square of a normal number, averaged over a few, is this share of its mean.
  constexpr double median_share = 0.8;
  constexpr double common = 4.0;  // weight of the common share, in coefficients
  const double share = median(std::move(shares)) / median_share;
  return (own * variances + common * share * squares) / (own + common);
}

/// The eigenvectors as matrices.
struct Triples {
  ComplexMatrix right, left;  ///< n x k
  ComplexVector s;
};

Triples as_matrices(std::span<const EigenTriple> list, Eigen::Index n) {
  const auto count = static_cast<Eigen::Index>(list.size());
  Triples all{ComplexMatrix(n, count), ComplexMatrix(n, count), ComplexVector(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const EigenTriple& one = list[static_cast<std::size_t>(i)];
    all.right.col(i) = one.right;
    all.left.col(i) = one.left;
    all.s[i] = one.s;
  }
  return all;
}

/// |s|^power or s^power.
template <class Scalar>
Scalar power_of(const Scalar& s, int power) {
  return power == 2 ? s * s : power == 1 ? s : Scalar(1.0);
}

/// y^T B z with the magnitudes of y and z, per eigenvalue.
Vector magnitudes_through(const Matrix& B, const Triples& triples, int power) {
  const Matrix products = B * triples.right.cwiseAbs();
  Vector sums = triples.left.cwiseAbs().cwiseProduct(products).colwise().sum().transpose();
  for (Eigen::Index i = 0; i < sums.size(); ++i) sums[i] *= power_of(std::abs(triples.s[i]), power);
  return sums;
}

/// Variance of Re(y^H E z), where the entries of E are independent with these variances.
double variance_of_real_part(const Matrix& variances, const ComplexVector& y, const ComplexVector& z) {
  const Vector a = y.real(), b = y.imag(), c = z.real(), d = z.imag();
  return a.cwiseAbs2().dot(variances * c.cwiseAbs2()) + b.cwiseAbs2().dot(variances * d.cwiseAbs2()) +
         2.0 * a.cwiseProduct(b).dot(variances * c.cwiseProduct(d));
}

}  // namespace

InterpolationErrors::InterpolationErrors(int parameter, const std::vector<double>& values,
                                         const std::array<PencilSamples, 3>& samples,
                                         const std::vector<SamplePiece>& pieces, SampleErrorOptions options)
    : parameter_(parameter), values_(values), samples_(samples), pieces_(pieces), options_(options) {
  for (const SamplePiece& piece : pieces_) {
    std::array<Matrix, 3>& all = variances_.emplace_back();
    if (piece.size() < fewest_for_noise || piece.reduced.rows() == 0) continue;
    Eigen::Index n_entries = 0;
    for (const PencilSamples& one : samples_) n_entries += varying_entries(one, piece);
    const RoughPart rough = rough_part(piece, n_entries);
    for (std::size_t i = 0; i < 3; ++i) all[i] = entry_variances(samples_[i], piece, rough);
  }
}

double InterpolationErrors::place_of_largest_error(std::size_t gap, double from, double to) const {
  const double low = std::max(from, values_[gap]), high = std::min(to, values_[gap + 1]);
  const RationalInterpolant& interpolant = piece_at(pieces_, 0.5 * (low + high)).interpolant;
  constexpr int places_in_gap = 50;
  double best = 0.5 * (low + high), largest = 0.0;
  for (int i = 1; i < places_in_gap; ++i) {
    const double x = low + (high - low) * i / places_in_gap;
    const double factor = interpolant.error_factor(x);
    if (factor <= largest) continue;
    largest = factor;
    best = x;
  }
  return best;
}

double InterpolationErrors::shape(double x) const {
  if (values_.size() < 2) return 1.0;
  const RationalInterpolant& interpolant = piece_at(pieces_, x).interpolant;
  const std::size_t gap = gap_of(values_, x);
  const double largest =
      interpolant.error_factor(place_of_largest_error(gap, values_[gap], values_[gap + 1]));
  const double share = std::min(1.0, interpolant.error_factor(x) / largest);
  // Nothing beyond an end tells how the error falls to zero there: it may be that of a root.
  const std::vector<double>& nodes = interpolant.nodes();
  const bool at_end =
      x < 0.5 * (nodes[0] + nodes[1]) || x > 0.5 * (nodes[nodes.size() - 2] + nodes[nodes.size() - 1]);
  return at_end && share > 0.0 ? 1.0 : share;
}

SampleBounds InterpolationErrors::between(std::size_t gap, std::span<const EigenTriple> triples) const {
  const double middle = 0.5 * (values_[gap] + values_[std::min(gap + 1, values_.size() - 1)]);
  const SamplePiece& piece = piece_at(pieces_, middle);
  const auto& variances = variances_[static_cast<std::size_t>(&piece - pieces_.data())];
  const GapWindow window = window_at(piece, gap);
  const GapEstimators here = gap_estimators(piece, window, options_);
  const auto n_samples = static_cast<Eigen::Index>(window.nodes.size());
  const auto n_triples = static_cast<Eigen::Index>(triples.size());
  std::array<ComplexMatrix, 3> coefficients;
  const Vector weights =
      RationalInterpolant(window.nodes,
                          std::min<int>(piece.interpolant.degree(), static_cast<int>(n_samples) - 1),
                          piece.interpolant.denominator())
          .values(middle);
  for (std::size_t c = 0; c < 3; ++c) {
    const PencilSamples& one = samples_[c];
    coefficients[c] = ComplexMatrix::Zero(one.at(0).rows(), one.at(0).cols());
    for (Eigen::Index j = 0; j < n_samples; ++j)
      coefficients[c] += weights[j] * one.at(window.first + static_cast<std::size_t>(j));
  }
  const Triples all = as_matrices(triples, samples_[0].at(0).rows());

  ComplexMatrix shares = ComplexMatrix::Zero(n_triples, n_samples);
  Vector variance = Vector::Zero(n_triples), of_growth = variance, floor = variance, digits = variance;
  for (std::size_t c = 0; c < 3; ++c) {
    const PencilSamples& one = samples_[c];
    const Matrix magnitude = coefficients[c].cwiseAbs();
    floor += rounding * magnitudes_through(magnitude, all, one.power);
    if (!one.entry_errors.empty()) {
      Matrix errors = Matrix::Zero(magnitude.rows(), magnitude.cols());
      for (Eigen::Index j = 0; j < n_samples; ++j)
        errors += here.weights[j] * one.errors_at(window.first + static_cast<std::size_t>(j));
      if (one.is_constant()) errors = one.errors_at(0);
      digits += magnitudes_through(errors, all, one.power);
    }
    if (one.is_constant()) continue;
    for (Eigen::Index j = 0; j < n_samples; ++j) {
      const ComplexMatrix products = one.at(window.first + static_cast<std::size_t>(j)) * all.right;
      for (Eigen::Index i = 0; i < n_triples; ++i)
        shares(i, j) += power_of(all.s[i], one.power) * all.left.col(i).dot(products.col(i));
    }
    if (variances[c].size() == 0) continue;
    for (Eigen::Index i = 0; i < n_triples; ++i) {
      const ComplexVector y = std::conj(power_of(all.s[i], one.power)) * all.left.col(i),
                          z = all.right.col(i);
      variance[i] += y.cwiseAbs2().dot(variances[c] * z.cwiseAbs2());
      of_growth[i] += variance_of_real_part(variances[c], y, z);
    }
  }
  Vector smooth = Vector::Zero(n_triples), smooth_growth = smooth;
  const auto raise = [&](const Matrix& combinations, double factor) {
    if (combinations.cols() == 0) return;
    const ComplexMatrix errors = factor * shares * combinations;
    smooth = smooth.cwiseMax(errors.cwiseAbs().rowwise().maxCoeff());
    smooth_growth = smooth_growth.cwiseMax(errors.real().cwiseAbs().rowwise().maxCoeff());
  };
  for (std::size_t i = 0; i < 3; ++i) raise(here.differences[i], here.share[i]);
  raise(here.leave_one_out, 1.0);
  raise(here.rival, 1.0);
  if (here.before.cols() > 0) {
    const ComplexMatrix before = shares * here.before, behind = shares * here.behind;
    const Matrix least = before.cwiseAbs().cwiseMin(behind.cwiseAbs());
    const Matrix least_growth = before.real().cwiseAbs().cwiseMin(behind.real().cwiseAbs());
    smooth = smooth.cwiseMax(least.rowwise().maxCoeff());
    smooth_growth = smooth_growth.cwiseMax(least_growth.rowwise().maxCoeff());
  }
  const Matrix& nearby = here.nearby;
  const bool sees_nearby =
      nearby.cols() > 0 && n_samples - piece.interpolant.degree() > fewest_for_noise_nearby;
  // From the variance of an error, and from what the samples nearby miss of it.
  const auto rough = [&](const Vector& expected, const Vector& sum) -> Vector {
    const Vector on_range = options_.deviations * expected.cwiseSqrt();
    if (!sees_nearby) return here.amplification * on_range + floor;
    // By chance all of a few may be small, so the variance counts like one more sample. It takes the entries
    // for independent of each other and may be far too large, so that its weight is limited.
    constexpr double largest_ratio = 30.0;
    const auto own = static_cast<double>(nearby.cols());
    const Vector squares = (sum + expected.cwiseMin(largest_ratio / own * sum)) / (own + 1.0);
    const Vector beside = options_.deviations_nearby * squares.cwiseSqrt();
    return here.amplification * on_range.cwiseMin(beside) + floor;
  };
  const ComplexMatrix missed =
      sees_nearby ? ComplexMatrix(shares * nearby) : ComplexMatrix::Zero(n_triples, 1);
  return {smooth, rough(variance, missed.cwiseAbs2().rowwise().sum()), digits, smooth_growth,
          rough(of_growth, missed.real().cwiseAbs2().rowwise().sum())};
}

}  // namespace eigentrail
