#include "continuation/events/roots_on_step.hpp"

namespace eigentrail {
namespace {

/// As a share of an interval: distance from its ends up to which roots are accepted.
constexpr double beside = 0.05;
/// In steps: intervals are not halved below this length; one that is still not resolved counts as a root.
constexpr double smallest_piece = 1e-8;
/// Roots closer than this many of these lengths are the same.
constexpr double same_piece = 10.0;
/// Degree of the Chebyshev interpolant of the function on a piece, a little above that of the dense output.
constexpr int degree = 12;
/// A piece is halved if one of the last two Chebyshev coefficients is more than this share of the largest
/// one. The roots only start Newton's method, so that this accuracy suffices.
constexpr double resolved = 1e-4;
/// Least ratio of the distance of two eigenvalues to its change on a piece without a root nearby.
constexpr double stay_apart = 3.0;
/// Isolating a kink takes about thirty halvings. Many more pieces mean that the gap is rounding: the two
/// eigenvalues coincide on the whole step, like those of rigid-body modes at s = 0.
constexpr int most_pieces = 300;

/// Region in which roots of a piece must be excluded, in shares of it; `off_axis`: how far from the real
/// axis.
Rectangle looked_at(double off_axis) {
  return {0.5, 0.5 + beside + margin_of_region, off_axis + margin_of_region};
}

/// Largest distance from the axis of accepted roots, in shares of the piece. A Chebyshev interpolant is not
/// accurate farther away than half the piece.
double farthest_off_axis(double wanted) {
  constexpr double half_piece = 0.5;
  return std::min(half_piece, wanted);
}

/// Whether the gap of a block of two certainly has no root near the step. That gap is the second smooth
/// function of the block, a polynomial on the step: bounds by its coefficients need no samples.
bool of_two_has_none(const HermiteInterpolant& functions, double off_axis) {
  if (functions.size() != 2) return false;
  Rectangle step = looked_at(farthest_off_axis(off_axis));
  const double middle = std::exchange(step.center, 0.0).real();
  return has_no_root_in(functions.series(middle, functions.degree()).row(1).transpose(), step);
}

}  // namespace

RootsOnStep::RootsOnStep(EigenvalueSampler& sampler, int a, int b, double off_axis, const Stretch& stretch)
    : distance_([&sampler, a, b](double t) {
        const ComplexVector& roots = sampler(t);
        return roots[a] - roots[b];
      }),
      resolution_([&sampler, a, b](double t) { return sampler.resolution_at(t, a, b); }),
      off_axis_(off_axis),
      stretch_(stretch),
      of_gap_(true),
      has_none_(of_two_has_none(sampler.functions(), off_axis) || sampler.are_hidden(a, b)) {}

std::vector<Complex> RootsOnStep::find() {
  if (!has_none_) search(stretch_.from, stretch_.to);
  return std::move(roots_);
}

std::vector<Complex> RootsOnStep::find_first(double from, FirstRoots& first) {
  from_ = from;
  first_ = &first;
  return find();
}

bool RootsOnStep::is_closest(Complex root) {
  constexpr double half_widths = 3.0;
  constexpr double farther = 1.3;  // far below 3.2, since other eigenvalues disturb this law
  const double reach = half_widths * std::abs(root.imag());
  const double at = std::clamp(root.real(), 0.0, 1.0);
  const double here = std::abs(distance_(at));
  const auto parts = [&](double t) { return t < 0.0 || t > 1.0 || std::abs(distance_(t)) >= farther * here; };
  return parts(at - reach) && parts(at + reach);
}

void RootsOnStep::add(Complex root) {
  roots_.push_back(root);
  if (first_ != nullptr && root.real() > from_) first_->found(root.real());
}

/// Adds the roots between t = begin and t = end, from left to right.
void RootsOnStep::search(double begin, double end) {
  if (first_ != nullptr && begin > first_->up_to) return;
  if (pieces_ > most_pieces) return;
  if (++pieces_ > most_pieces) return roots_.clear();
  const double length = end - begin;
  if (length < smallest_piece) {
    if (roots_.empty() || std::abs(begin - roots_.back()) > same_piece * smallest_piece) add(begin);
    return;
  }
  const Complex at_begin = distance_(begin);
  double least = std::abs(at_begin);
  double moved = 0.0;
  const auto function = [&](double u) -> Complex {
    const Complex d = distance_(begin + u * length);
    least = std::min(least, std::abs(d));
    moved = std::max(moved, std::abs(d - at_begin));
    return of_gap_ ? 0.25 * d * d : d;
  };
  // From left to right first: eigenvalues are told apart by those of the nearest place before.
  for (const double u : {0.25, 0.5, 0.75, 1.0}) function(u);
  const ComplexVector coefficients = chebyshev_coefficients(function, degree);
  // Where the distance is everywhere more than a few times its change, there is no root nearby.
  if (least > stay_apart * moved) return;
  const double largest = coefficients.cwiseAbs().maxCoeff();
  if ((of_gap_ ? std::sqrt(largest) : largest) <= resolution_(begin + 0.5 * length)) return;
  if (coefficients.tail(2).cwiseAbs().maxCoeff() > resolved * largest) {
    const double middle = begin + 0.5 * length;
    search(begin, middle);
    search(middle, end);
    return;
  }
  const double off_axis = farthest_off_axis(off_axis_ / length);
  if (chebyshev_has_no_root_in(coefficients, looked_at(off_axis))) return;
  for (const Complex root : chebyshev_roots(coefficients)) {
    const bool on_piece = root.real() > -beside && root.real() < 1.0 + beside;
    if (on_piece && std::abs(root.imag()) <= off_axis) add(begin + root * length);
  }
}

}  // namespace eigentrail
