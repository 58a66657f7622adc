#include "model/gap_estimators.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/sample_interpolation.hpp"

namespace eigentrail {
namespace {

/// Samples next to a gap that are looked at; the others change the estimate little.
constexpr std::size_t most_samples = 48;
static_assert(most_samples >= most_samples_with_poles, "poles are fitted to all samples of a piece");
/// Samples near a gap whose leave-one-out errors are averaged.
constexpr std::size_t nearby_samples = 10;

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

/// Interpolants of the samples of a window, of at least two.
class GapInterpolants {
 public:
  GapInterpolants(const SamplePiece& piece, const GapWindow& window) : piece_(piece), window_(window) {}

  Eigen::Index samples() const { return static_cast<Eigen::Index>(window_.nodes.size()); }
  int degree() const { return std::min(piece_.interpolant.degree(), static_cast<int>(samples()) - 1); }

  /// The interpolant of degree d at places of the gap, a place per column.
  Matrix values(int d) const {
    if (samples() == 2 && d < 1) return nearest_samples();
    d = std::max(piece_.interpolant.denominator().degree(), d);
    const RationalInterpolant interpolant(window_.nodes, d, denominator(d));
    Matrix columns(samples(), places_in_gap.size());
    for (std::size_t i = 0; i < places_in_gap.size(); ++i)
      columns.col(static_cast<Eigen::Index>(i)) = interpolant.values(place(i));
    return columns;
  }

  /// The line through the samples `first` and `first` + 1, likewise.
  Matrix line(std::size_t first) const {
    const double from = window_.nodes[first], length = window_.nodes[first + 1] - from;
    Matrix columns = Matrix::Zero(samples(), places_in_gap.size());
    for (std::size_t i = 0; i < places_in_gap.size(); ++i) {
      const double share = (place(i) - from) / length;
      columns.col(static_cast<Eigen::Index>(i)).segment<2>(static_cast<Eigen::Index>(first)) << 1.0 - share,
          share;
    }
    return columns;
  }

  /// What is missed at the samples `begin` ... `end` - 1, each left out; not at the first and the last one.
  Matrix missed_at(std::size_t begin, std::size_t end) const {
    begin = std::max<std::size_t>(begin, 1);
    end = std::min(end, window_.nodes.size() - 1);
    Matrix columns(samples(), static_cast<Eigen::Index>(end > begin ? end - begin : 0));
    for (std::size_t node = begin; node < end; ++node)
      columns.col(static_cast<Eigen::Index>(node - begin)) =
          leave_one_out(window_.nodes, degree(), node,
                        piece_.without_one.empty() ? Denominator{} : piece_.without_one[node]);
    return columns;
  }

 private:
  double place(std::size_t i) const {
    const double from = window_.nodes[window_.gap];
    return from + places_in_gap[i] * (window_.nodes[window_.gap + 1] - from);
  }

  Denominator denominator(int d) const {
    const Denominator& known = piece_.interpolant.denominator();
    if (known.degree() == 0 || d == degree()) return known;
    return fitted_denominator(window_.nodes, piece_.reduced, d, known.degree()).value_or(known);
  }

  const SamplePiece& piece_;
  const GapWindow& window_;
};

/// What interpolants of four successive degrees differ by, with factors that extrapolate from the errors of
/// one degree to those of the next.
void compare_degrees(const GapInterpolants& interpolants, const Matrix& reduced,
                     const SampleErrorOptions& options, GapEstimators& result) {
  const int top = std::min(interpolants.degree() + 1, static_cast<int>(interpolants.samples()) - 1);
  std::array<double, 3> norms{};
  Matrix above = interpolants.values(top);
  for (int i = 0; i < 3; ++i) {
    Matrix below = interpolants.values(top - i - 1);
    const auto at = static_cast<std::size_t>(i);
    result.differences[at] = above - below;
    norms[at] = (reduced * result.differences[at]).colwise().norm().maxCoeff();
    above = std::move(below);
  }
  const auto ratio = [](double a, double b, double most) { return b > 0.0 ? std::min(most, a / b) : 0.0; };
  const double rate = ratio(norms[0], norms[1], options.slowest);
  const double extrapolated = options.safety / (1.0 - rate);
  result.share = {extrapolated, extrapolated * rate,
                  extrapolated * ratio(norms[0], norms[2], options.slowest * options.slowest)};
}

}  // namespace

GapWindow window_at(const SamplePiece& piece, std::size_t gap) {
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

GapEstimators gap_estimators(const SamplePiece& piece, const GapWindow& window,
                             const SampleErrorOptions& options) {
  GapEstimators result;
  const std::size_t n = window.nodes.size();
  if (n == 1) {
    result.weights = Vector::Ones(1);
    return result;
  }
  const GapInterpolants interpolants(piece, window);
  const Matrix used = interpolants.values(interpolants.degree());
  result.weights = used.cwiseAbs().rowwise().maxCoeff();
  result.amplification = std::max(1.0, used.colwise().norm().maxCoeff());
  compare_degrees(interpolants, piece.reduced.middleCols(window.offset, interpolants.samples()), options,
                  result);
  const double one_sided = window.gap == 0 || window.gap + 2 == n ? options.at_an_end : 1.0;
  const Smoothness smoothness =
      smoothness_at(piece, window.gap + static_cast<std::size_t>(window.offset), options);
  result.rival = one_sided * options.safety / (1.0 - std::min(options.slowest, smoothness.gain)) *
                 (interpolants.values(smoothness.modest) - used);
  if (smoothness.gain > options.may_have_kinks && window.gap > 0 && window.gap + 3 <= n) {
    result.before = options.beside_a_kink * (interpolants.line(window.gap - 1) - used);
    result.behind = options.beside_a_kink * (interpolants.line(window.gap + 1) - used);
  }
  // With equidistant nodes a missing one lets the error grow by about pi (d + 1) / 2 + 0.8: the square of
  // (2 m)!! / (2 m - 1)!!, m = (d + 1) / 2.
  const double growth = 0.5 * std::numbers::pi * (interpolants.degree() + 1) + 0.8;
  result.leave_one_out =
      one_sided * options.leave_one_out / growth * interpolants.missed_at(window.gap, window.gap + 2);
  const std::size_t half = nearby_samples / 2;
  const std::size_t begin = window.gap + 1 > half ? window.gap + 1 - half : 0;
  result.nearby = interpolants.missed_at(begin, window.gap + 1 + half);
  return result;
}

}  // namespace eigentrail
