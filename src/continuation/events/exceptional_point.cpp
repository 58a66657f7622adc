#include "continuation/events/exceptional_point.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/events/bordered_pencil.hpp"

namespace eigentrail {
namespace {

/// Newton iterations: from the prediction a few, close to another exceptional point linear convergence first.
constexpr int most_iterations = 30;
/// As a share of the distance from the real axis (of mu: of its size): the last move, and moves that may be
/// rounding.
constexpr double settled_move = 1e-12;
constexpr double loosely_settled = 1e-6;
/// As a share of the move before: a longer move no longer shrinks. Beside a double root each is half as long.
constexpr double still_shrinking = 0.7;
/// As a share of the reach, and of mu: longer moves are shortened.
constexpr double longest_move = 0.5;
/// Steps of the way to the real axis or away from it, as shares of it: the first, the least, and how much
/// longer each may be than the one before.
constexpr double first_way = 0.125;
constexpr double least_way = 1e-5;
constexpr double growth = 2.0;
/// An eigenvalue counts as followed if its correction is at most this share of its distance from the other
/// one, and of what it moved.
constexpr double certain = 0.2;
/// As a share of the distance of the other one: the last move of an eigenvalue on that way, which only leads
/// to the next place. With a smaller one the way takes up to twice as many factorizations.
constexpr double on_the_way = 1e-2;

bool is_finite(Complex z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// A root mu of f at fixed h by Newton's method; empty if it does not settle. `moved`: largest allowed way.
/// `last_move`: how short the last move is to be; what is left is about its square over the distance of other
/// roots. `has_borders`: they belong to the root already.
std::optional<Complex> root_at(const PencilAt& pencil, Complex mu, double moved, double last_move,
                               bool has_borders, Bordered& bordered) {
  const Complex start = mu;
  if (!has_borders) bordered.at(pencil, mu, 1);
  for (int i = 0; i < most_iterations; ++i) {
    const auto f = bordered.at(pencil, mu, 1);
    const Complex move = -f.f / f.mu;
    if (!is_finite(move)) return std::nullopt;
    mu += move;
    if (std::abs(mu - start) > moved) return std::nullopt;
    if (std::abs(move) <= std::max(settled_move * std::abs(mu), last_move)) return mu;
  }
  return std::nullopt;
}

/// The place between two close eigenvalues where f_mu vanishes, from a place near it. The borders come to
/// belong to the two.
Complex between_eigenvalues(const PencilAt& pencil, Complex mu, Bordered& bordered) {
  constexpr int rounds = 10;       // f is a parabola in mu once the borders belong to the two
  constexpr double enough = 1e-9;  // relative: the last move. What is left, Newton's method for both corrects
  constexpr double farthest = 0.2;  // of mu, from the start: beyond that it is between others
  bordered.at(pencil, mu, 1);       // with borders that belong to nothing yet
  const Complex start = mu;
  for (int i = 0; i < rounds; ++i) {
    const auto f = bordered.at(pencil, mu, 2);
    const Complex move = -f.mu / f.mumu;
    if (!is_finite(move) || std::abs(mu + move - start) > farthest * std::abs(start)) return start;
    mu += move;
    if (std::abs(move) <= enough * std::abs(mu)) break;
  }
  return mu;
}

/// Two close eigenvalues of a pencil, followed from one h to the next.
class FollowedTwo {
 public:
  explicit FollowedTwo(const ReducedPencil& pencil)
      : pencil_(pencil), bordered_{Bordered(dimensions_of(pencil)), Bordered(dimensions_of(pencil))} {}

  /// Both at a place; empty if one of them is not within `allowed` of where it is expected. `last_move` as in
  /// root_at.
  std::optional<std::array<Complex, 2>> at(const PencilAt& here, const std::array<Complex, 2>& expected,
                                           double allowed, double last_move) {
    std::array<Complex, 2> found{};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto root = root_at(here, expected[k], allowed, last_move, have_borders_, bordered_[k]);
      if (!root) {
        have_borders_ = false;
        return std::nullopt;
      }
      found[k] = *root;
    }
    have_borders_ = true;
    return found;
  }

  /// dmu/dh of one of them, where it was found.
  Complex slope(const PencilAt& here, std::size_t k, Complex mu) {
    const auto f = bordered_[k].at(here, mu, 1);
    return -f.h / f.mu;
  }

  /// The right vector of one of them, in the coordinates of the pencil.
  ComplexVector vector(std::size_t k) const {
    if (pencil_.complex_sign == 0) return bordered_[k].vector();
    return from_complex_coordinates(bordered_[k].vector(), pencil_.complex_sign);
  }

 private:
  const ReducedPencil& pencil_;
  std::array<Bordered, 2> bordered_;
  bool have_borders_ = false;  ///< that belong to the two
};

/// The exceptional point near h. The mean of the two eigenvalues varies little between the real axis and a
/// close exceptional point; for farther ones it is followed there.
std::optional<ExceptionalPoint> exceptional_point_near(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       const std::array<Complex, 2>& mu, double allowed) {
  const auto from = [&](Complex mean) -> std::optional<ExceptionalPoint> {
    const double reach = allowed + std::abs(h.imag());
    const auto point = find_exceptional_point(pencil, chart, h, mean, reach, {});
    return point && std::abs(point->h - h) <= allowed ? point : std::nullopt;
  };
  if (const auto point = from(0.5 * (mu[0] + mu[1]))) return point;
  const auto mean = mean_at(pencil, chart, 0.0, h, mu);
  return mean ? from(*mean) : std::nullopt;
}

}  // namespace

std::optional<ExceptionalPoint> find_exceptional_point(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       Complex mu, double reach,
                                                       const std::vector<Complex>& known) {
  Bordered bordered(dimensions_of(pencil));
  const Complex start = h;
  const double size_of_mu = std::abs(mu);
  mu = between_eigenvalues(PencilAt(pencil, chart, h, 0), mu, bordered);
  double last_move = INFINITY;
  for (int i = 0; i < most_iterations; ++i) {
    const auto f = bordered.at(PencilAt(pencil, chart, h, 2), mu, 2);
    // [f_mu f_h; f_mumu f_muh] [dmu; dh] = -[f; f_mu]
    const Complex determinant = f.mu * f.muh - f.h * f.mumu;
    Complex dh = (f.mumu * f.f - f.mu * f.mu) / determinant;
    Complex repelled = 0.0;
    for (const Complex other : known) repelled += 1.0 / (h - other);
    dh /= 1.0 + dh * repelled;
    Complex dmu = (-f.mu - f.muh * dh) / f.mumu;
    if (!is_finite(dh) || !is_finite(dmu)) return std::nullopt;
    const double too_far = std::max(std::abs(dh) / reach, std::abs(dmu) / size_of_mu) / longest_move;
    if (too_far > 1.0) {
      dh /= too_far;
      dmu /= too_far;
    }
    h += dh;
    mu += dmu;
    if (std::abs(h - start) > reach) return std::nullopt;
    // The place is known to rounding over the slope of the discriminant: below that moves no longer shrink.
    const double move = std::abs(dh) / std::abs(h.imag());
    const bool at_rounding = move <= loosely_settled && std::abs(dh) > still_shrinking * last_move;
    last_move = std::abs(dh);
    if (move > settled_move && !at_rounding) continue;
    // The next root of the critical value of f over mu, by its curvature.
    const Complex curvature = f.hh - f.muh * f.muh / f.mumu;
    return ExceptionalPoint{h, mu, -2.0 * f.h / f.mumu, h - 2.0 * f.h / curvature, -f.muh / f.mumu};
  }
  return std::nullopt;
}

std::optional<Complex> mean_at(const ReducedPencil& pencil, Chart chart, double from, Complex h,
                               std::array<Complex, 2> mu) {
  constexpr double enough = 0.9;  // of the way: close to an exceptional point only the mean is smooth
  FollowedTwo two(pencil);
  const Complex way = h - from;
  std::array<Complex, 2> slope{};
  double share = 0.0;
  const auto go_to = [&](double next) {
    const PencilAt here(pencil, chart, from + next * way, 1);
    const double apart = std::abs(mu[0] - mu[1]);
    std::array<Complex, 2> expected = mu;
    for (std::size_t k = 0; k < 2; ++k) expected[k] += (next - share) * slope[k];
    const auto found = two.at(here, expected, certain * apart, on_the_way * apart);
    if (!found) return false;
    mu = *found;
    for (std::size_t k = 0; k < 2; ++k) slope[k] = two.slope(here, k, mu[k]) * way;
    share = next;
    return true;
  };
  if (!go_to(0.0)) return std::nullopt;
  double step = first_way;
  while (share < enough) {
    if (go_to(std::min(share + step, 1.0))) {
      step *= growth;
    } else if ((step *= 0.5) < least_way) {
      return std::nullopt;
    }
  }
  return 0.5 * (mu[0] + mu[1]) + (1.0 - share) * 0.5 * (slope[0] + slope[1]);
}

std::optional<std::array<EigenvalueBelow, 2>> eigenvalues_below(const ReducedPencil& pencil, Chart chart,
                                                                const ExceptionalPoint& point) {
  FollowedTwo two(pencil);
  const Complex down(0.0, -point.h.imag());
  // The mean of the two, and the square of half their distance: both are smooth on the way, unlike the two.
  // By the share of the way: value, slope and second derivative.
  Eigen::Vector2cd value(point.mu, 0.0);
  Eigen::Vector2cd slope = Eigen::Vector2cd(point.mean_slope, point.slope) * down;
  Eigen::Vector2cd bend(0.0, 2.0 * point.slope / (point.h - point.next) * down * down);
  double share = 0.0, step = first_way;
  while (step > least_way) {
    const double next = std::min(share + step, 1.0), moved = next - share;
    const Eigen::Vector2cd expected = value + moved * (slope + 0.5 * moved * bend);
    const Complex half = std::sqrt(expected[1]);
    const double apart = 2.0 * std::abs(half);
    const auto found =
        two.at(PencilAt(pencil, chart, point.h + next * down, 0), {expected[0] + half, expected[0] - half},
               certain * apart, next < 1.0 ? on_the_way * apart : 0.0);
    if (!found) {
      step = 0.5 * moved;
      continue;
    }
    const auto [a, b] = *found;
    if (next == 1.0)
      return std::array<EigenvalueBelow, 2>{EigenvalueBelow{a, two.vector(0)},
                                            EigenvalueBelow{b, two.vector(1)}};
    const Eigen::Vector2cd here(0.5 * (a + b), 0.25 * (a - b) * (a - b));
    const Eigen::Vector2cd change = 2.0 * ((here - value) / moved - slope);  // of the slope, as on a parabola
    bend = change / moved;
    slope += change;
    value = here;
    share = next;
    step *= growth;
  }
  return std::nullopt;
}

std::optional<VeeringPlace> located_veering(const ReducedPencil& pencil, Chart chart, VeeringPlace seen,
                                            const std::array<Complex, 2>& mu, double allowed) {
  VeeringPlace sum;
  double count = 0.0;
  for (const double sign : {1.0, -1.0}) {
    const Complex h(seen.offset, sign * seen.half_width);
    const auto point = exceptional_point_near(pencil, chart, h, mu, allowed);
    if (!point) continue;
    sum.offset += point->h.real();
    sum.half_width += std::abs(point->h.imag());
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  return VeeringPlace{sum.offset / count, sum.half_width / count};
}

}  // namespace eigentrail
