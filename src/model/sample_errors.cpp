#include "eigentrail/model/sample_errors.hpp"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/orthonormal.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {
namespace {

/// A few roundings of double precision, relative to each entry.
constexpr double rounding = 4e-16;
/// Samples next to a gap that are looked at; the others change the estimate little.
constexpr std::size_t most_samples = 48;
static_assert(most_samples >= most_samples_with_poles, "poles are fitted to all samples of a piece");
/// With fewer samples more than the degree, the leave-one-out errors of all samples are alike.
constexpr Eigen::Index fewest_for_noise_nearby = 7;
/// Samples near a gap whose leave-one-out errors are averaged.
constexpr std::size_t nearby_samples = 10;
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

RoughPart rough_part(const SamplePiece& piece, double n_entries) {
  const auto n = static_cast<Eigen::Index>(piece.size());
  const Eigen::Index high = std::max<Eigen::Index>(2, n / 4);
  const Matrix polynomials = products_with_polynomials(piece.interpolant);
  const Matrix coefficients = piece.reduced * polynomials;
  Eigen::JacobiSVD<Matrix> lower(coefficients.leftCols(n - high), Eigen::ComputeThinU | Eigen::ComputeThinV);
  constexpr double same_direction = 1e-13;
  lower.setThreshold(same_direction);
  // With more directions than half of the coefficients, those of errors that are not smooth are among them.
  const Eigen::Index main = std::min((n - high) / 2, lower.rank());
  const Matrix part = lower.matrixV().leftCols(main) *
                      lower.singularValues().head(main).cwiseInverse().asDiagonal() *
                      lower.matrixU().leftCols(main).transpose() * coefficients.rightCols(high);
  constexpr double least_freedom = 0.05;
  return {polynomials.rightCols(high) - polynomials.leftCols(n - high) * part,
          std::max(least_freedom, 1.0 - static_cast<double>(main) / n_entries)};
}

bool varies(const PencilSamples& samples, const SamplePiece& piece, Eigen::Index row, Eigen::Index column) {
  const double first = samples.at(piece.first)(row, column);
  for (std::size_t i = 1; i < piece.size(); ++i) {
    if (samples.at(piece.first + i)(row, column) != first) return true;
  }
  return false;
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

/// The samples of a piece that an estimate for a gap looks at.
struct Window {
  std::size_t first = 0;      ///< index of the first sample
  std::vector<double> nodes;  ///< their values
  std::size_t gap = 0;        ///< the gap, counted in the window
  Eigen::Index offset = 0;    ///< of the window in the piece
};

Window window_at(const SamplePiece& piece, std::size_t gap) {
  const std::vector<double>& all = piece.interpolant.nodes();
  const std::size_t in_piece = gap - piece.first;
  const std::size_t half = most_samples / 2;
  const std::size_t begin = in_piece + 1 > half ? in_piece + 1 - half : 0;
  const std::size_t end = std::min(all.size(), begin + most_samples);
  return {piece.first + begin,
          {all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)},
          in_piece - begin,
          static_cast<Eigen::Index>(begin)};
}

/// What the interpolants of neighbouring degrees differ by at places of a gap, and what the leave-one-out
/// interpolants miss at its ends: combinations of the samples of the window, one per column.
struct Estimators {
  std::array<Matrix, 3> differences;        ///< of the highest pair of degrees, the next, the next
  Matrix leave_one_out;                     ///< what is missed at the ends of the gap
  Matrix nearby;                            ///< and at the samples near it
  std::array<double, 3> share = {1, 0, 0};  ///< factor of each difference
  Matrix rival;  ///< what the interpolant of the modest degree differs by, extrapolated
  /// What the lines through the two samples before the gap and behind it differ by: of a function with a kink
  /// in the gap, the smaller difference is true (subcell resolution: Harten, J. Comput. Phys. 83, 1989).
  Matrix before, behind;
  double amplification = 1.0;  ///< of errors of the samples that are not smooth
  Vector weights;              ///< largest magnitude of each basis function
};

constexpr std::array<double, 5> places_in_gap{0.1, 0.3, 0.5, 0.7, 0.9};

/// The nearest sample as an interpolant. Two samples are all that there is: the line between them is compared
/// with this, because the interpolant of degree 0 through two samples is the line, too.
Matrix nearest_samples() {
  Matrix columns = Matrix::Zero(2, places_in_gap.size());
  for (std::size_t i = 0; i < places_in_gap.size(); ++i)
    columns(places_in_gap[i] < 0.5 ? 0 : 1, static_cast<Eigen::Index>(i)) = 1.0;
  return columns;
}

/// How smooth the samples beside a gap are.
struct Smoothness {
  /// The degree, with as many poles, that predicts them best if each degree has to be worth it: where no
  /// degree is much better than the others, or one is by chance, it may be as close to the truth.
  int modest = 0;
  double gain = 0.0;  ///< error of the interpolant that is used there, as a share of that of degree 1
};

Smoothness smoothness_at(const SamplePiece& piece, std::size_t gap, const SampleErrorOptions& options) {
  const int degree = piece.interpolant.degree();
  Smoothness found{degree};
  if (piece.polynomials.norms.size() == 0) return found;
  const std::size_t begin = std::max<std::size_t>(gap, 2) - 1;
  const std::size_t count = std::min(gap + 3, piece.size() - 1) - begin;
  const Vector alike = piece.alike.over(begin, count);
  double least = INFINITY, factor = 1.0;
  for (Eigen::Index i = 0; i < alike.size(); ++i, factor *= options.worth_a_degree) {
    const double expected = factor * credible_error(alike, i);
    if (expected < least) found.modest = piece.alike.lowest + static_cast<int>(i);
    least = std::min(least, expected);
  }
  const double of_lines = piece.polynomials.over(begin, count)[0];
  if (of_lines > 0.0) found.gain = credible_error(alike, degree - piece.alike.lowest) / of_lines;
  return found;
}

/// The line through the samples `first` and `first` + 1 at places of a gap, a place per column.
Matrix line_through(const std::vector<double>& nodes, std::size_t first, std::size_t gap) {
  const auto row = static_cast<Eigen::Index>(first);
  Matrix columns = Matrix::Zero(static_cast<Eigen::Index>(nodes.size()), places_in_gap.size());
  for (std::size_t i = 0; i < places_in_gap.size(); ++i) {
    const double x = nodes[gap] + places_in_gap[i] * (nodes[gap + 1] - nodes[gap]);
    const double share = (x - nodes[first]) / (nodes[first + 1] - nodes[first]);
    columns(row, static_cast<Eigen::Index>(i)) = 1.0 - share;
    columns(row + 1, static_cast<Eigen::Index>(i)) = share;
  }
  return columns;
}

Estimators estimators(const SamplePiece& piece, const Window& window, const SampleErrorOptions& options) {
  const auto n = static_cast<Eigen::Index>(window.nodes.size());
  const int degree = std::min(piece.interpolant.degree(), static_cast<int>(n) - 1);
  const int top = std::min(degree + 1, static_cast<int>(n) - 1);
  std::array<Matrix, 4> values;  // of the interpolants of degree top, top - 1, top - 2, top - 3
  Estimators result;
  if (n == 1) {
    for (Matrix& difference : result.differences) difference.resize(1, 0);
    result.leave_one_out.resize(1, 0);
    result.nearby.resize(1, 0);
    result.rival.resize(1, 0);
    result.weights = Vector::Ones(1);
    return result;
  }
  const double from = window.nodes[window.gap];
  const double length = window.nodes[window.gap + 1] - from;
  const int n_poles = piece.interpolant.denominator().degree();
  const auto denominator_of = [&](int d) {
    if (n_poles == 0 || d == degree) return piece.interpolant.denominator();
    return fitted_denominator(window.nodes, piece.reduced, d, n_poles)
        .value_or(piece.interpolant.denominator());
  };
  const auto values_with = [&](int d, const Denominator& denominator) {
    const RationalInterpolant interpolant(window.nodes, d, denominator);
    Matrix columns(n, places_in_gap.size());
    for (std::size_t i = 0; i < places_in_gap.size(); ++i)
      columns.col(static_cast<Eigen::Index>(i)) = interpolant.values(from + places_in_gap[i] * length);
    return columns;
  };
  const auto values_of = [&](int d) {
    if (n == 2 && d < 1) return nearest_samples();
    d = std::max(n_poles, d);
    return values_with(d, denominator_of(d));
  };
  for (int i = 0; i < 4; ++i) values[static_cast<std::size_t>(i)] = values_of(top - i);
  const Matrix used = values_of(degree);
  result.weights = used.cwiseAbs().rowwise().maxCoeff();
  result.amplification = std::max(1.0, used.colwise().norm().maxCoeff());
  const bool at_end = window.gap == 0 || window.gap + 2 == window.nodes.size();
  const double one_sided = at_end ? options.at_an_end : 1.0;
  const Smoothness smoothness =
      smoothness_at(piece, window.gap + static_cast<std::size_t>(window.offset), options);
  const double slow = one_sided * options.safety / (1.0 - std::min(options.slowest, smoothness.gain));
  result.rival = slow * (values_of(smoothness.modest) - used);
  if (smoothness.gain > options.may_have_kinks && window.gap > 0 && window.gap + 3 <= window.nodes.size()) {
    result.before = options.beside_a_kink * (line_through(window.nodes, window.gap - 1, window.gap) - used);
    result.behind = options.beside_a_kink * (line_through(window.nodes, window.gap + 1, window.gap) - used);
  }
  const auto reduced = piece.reduced.middleCols(window.offset, n);
  std::array<double, 3> norms{};
  for (std::size_t i = 0; i < 3; ++i) {
    result.differences[i] = values[i] - values[i + 1];
    norms[i] = (reduced * result.differences[i]).colwise().norm().maxCoeff();
  }
  const auto ratio = [](double a, double b, double most) { return b > 0.0 ? std::min(most, a / b) : 0.0; };
  const double slowest = options.slowest;
  const double rate = ratio(norms[0], norms[1], slowest);
  const double extrapolated = options.safety / (1.0 - rate);
  result.share = {extrapolated, extrapolated * rate,
                  extrapolated * ratio(norms[0], norms[2], slowest * slowest)};
  // With equidistant nodes a missing one lets the error grow by about pi (d + 1) / 2 + 0.8: the square of
  // (2 m)!! / (2 m - 1)!!, m = (d + 1) / 2.
  const double factor = one_sided * options.leave_one_out / (0.5 * std::numbers::pi * (degree + 1) + 0.8);
  const auto missed_at = [&](std::size_t begin, std::size_t end) {
    begin = std::max<std::size_t>(begin, 1);
    end = std::min(end, window.nodes.size() - 1);
    Matrix columns(n, static_cast<Eigen::Index>(end > begin ? end - begin : 0));
    for (std::size_t node = begin; node < end; ++node)
      columns.col(static_cast<Eigen::Index>(node - begin)) = leave_one_out(
          window.nodes, degree, node, piece.without_one.empty() ? Denominator{} : piece.without_one[node]);
    return columns;
  };
  result.leave_one_out = factor * missed_at(window.gap, window.gap + 2);
  const std::size_t half = nearby_samples / 2;
  const std::size_t begin = window.gap + 1 > half ? window.gap + 1 - half : 0;
  result.nearby = missed_at(begin, window.gap + 1 + half);
  return result;
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
    double n_entries = 0.0;
    for (const PencilSamples& one : samples_) {
      if (!one.is_constant()) n_entries += static_cast<double>(one.at(0).size());
    }
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
  const auto above = std::upper_bound(values_.begin() + 1, values_.end() - 1, x);
  const auto gap = static_cast<std::size_t>(above - values_.begin()) - 1;
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
  const Window window = window_at(piece, gap);
  const Estimators estimators_here = estimators(piece, window, options_);
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
        errors += estimators_here.weights[j] * one.errors_at(window.first + static_cast<std::size_t>(j));
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
  for (std::size_t i = 0; i < 3; ++i) raise(estimators_here.differences[i], estimators_here.share[i]);
  raise(estimators_here.leave_one_out, 1.0);
  raise(estimators_here.rival, 1.0);
  if (estimators_here.before.cols() > 0) {
    const ComplexMatrix before = shares * estimators_here.before, behind = shares * estimators_here.behind;
    const Matrix least = before.cwiseAbs().cwiseMin(behind.cwiseAbs());
    const Matrix least_growth = before.real().cwiseAbs().cwiseMin(behind.real().cwiseAbs());
    smooth = smooth.cwiseMax(least.rowwise().maxCoeff());
    smooth_growth = smooth_growth.cwiseMax(least_growth.rowwise().maxCoeff());
  }
  const Matrix& nearby = estimators_here.nearby;
  const bool sees_nearby =
      nearby.cols() > 0 && n_samples - piece.interpolant.degree() > fewest_for_noise_nearby;
  // From the variance of an error, and from what the samples nearby miss of it.
  const auto rough = [&](const Vector& expected, const Vector& sum) -> Vector {
    const Vector on_range = options_.deviations * expected.cwiseSqrt();
    if (!sees_nearby) return estimators_here.amplification * on_range + floor;
    // By chance all of a few may be small, so the variance counts like one more sample. It takes the entries
    // for independent of each other and may be far too large, so that its weight is limited.
    constexpr double largest_ratio = 30.0;
    const auto own = static_cast<double>(nearby.cols());
    const Vector squares = (sum + expected.cwiseMin(largest_ratio / own * sum)) / (own + 1.0);
    const Vector here = options_.deviations_nearby * squares.cwiseSqrt();
    return estimators_here.amplification * on_range.cwiseMin(here) + floor;
  };
  const ComplexMatrix missed =
      sees_nearby ? ComplexMatrix(shares * nearby) : ComplexMatrix::Zero(n_triples, 1);
  return {smooth, rough(variance, missed.cwiseAbs2().rowwise().sum()), digits, smooth_growth,
          rough(of_growth, missed.real().cwiseAbs2().rowwise().sum())};
}

}  // namespace eigentrail
