#include "completeness/exceptional_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "completeness/spectrum_functions.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
namespace {

constexpr double widest = 0.01;       ///< half-width of a veering, of the range
constexpr double clear_of = 1e-7;     ///< of the range: narrower ones may count as collisions
constexpr double half_window = 0.04;  ///< of the range
constexpr int windows = 40;
constexpr int discriminant_degree = 28;

ComplexVector spectrum(const Family& family, Complex p) {
  const auto value = [p](const MatrixSeries& series) {
    ComplexMatrix sum = series.back().cast<Complex>();
    for (std::size_t k = series.size() - 1; k-- > 0;) sum = sum * p + series[k].cast<Complex>();
    return sum;
  };
  const auto n = family.M[0].rows();
  const Eigen::PartialPivLU<ComplexMatrix> mass(value(family.M));
  ComplexMatrix A = ComplexMatrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -mass.solve(value(family.K));
  A.bottomRightCorner(n, n) = -mass.solve(value(family.C));
  return qr_eigenvalues(A);
}

struct Pair {
  Complex mean, delta;  ///< ((s_a - s_b) / 2)^2
};

/// The two eigenvalues that are closest to each other, and to the mean if there is one.
Pair closest(const Family& family, Complex p, const std::optional<Complex>& mean) {
  const ComplexVector s = spectrum(family, p);
  double least = std::numeric_limits<double>::infinity();
  Pair best;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const Complex middle = 0.5 * (s[i] + s[j]);
      const double size = std::abs(s[i] - s[j]) + (mean ? 2.0 * std::abs(middle - *mean) : 0.0);
      if (size >= least) continue;
      least = size;
      best = {middle, 0.25 * (s[i] - s[j]) * (s[i] - s[j])};
    }
  }
  return best;
}

/// Means of the pairs of eigenvalues that are closest to each other.
std::vector<Complex> close_means(const Family& family, Complex p) {
  const ComplexVector s = spectrum(family, p);
  std::vector<std::pair<double, Complex>> pairs;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) pairs.emplace_back(std::abs(s[i] - s[j]), 0.5 * (s[i] + s[j]));
  }
  constexpr std::size_t most = 4;
  const auto last = pairs.begin() + static_cast<std::ptrdiff_t>(std::min(most, pairs.size()));
  std::partial_sort(pairs.begin(), last, pairs.end(),
                    [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Complex> means;
  for (auto pair = pairs.begin(); pair != last; ++pair) means.push_back(pair->second);
  return means;
}

std::string describe(const char* what, Complex p, Complex s) {
  std::ostringstream text;
  text.precision(10);
  text << what << " veering at " << p.real() << ", half-width ";
  text.precision(4);
  text << p.imag() << ", s " << s.real() << " + " << std::abs(s.imag()) << "j";
  return text.str();
}

}  // namespace

std::optional<ExceptionalPoint> corrected(const Family& family, Complex p, std::optional<Complex> s) {
  Complex before = p + Complex(1e-5, 1e-5);
  Pair at_before = closest(family, before, s);
  Complex now = p;
  for (int i = 0; i < 40; ++i) {
    const Pair at_now = closest(family, now, at_before.mean);
    const Complex slope = (at_now.delta - at_before.delta) / (now - before);
    const Complex move = -at_now.delta / slope;
    if (!std::isfinite(std::abs(move)) || std::abs(move) > 0.1) return {};
    before = now;
    at_before = at_now;
    now += move;
    if (std::abs(now - p) > 0.2) return {};
    if (std::abs(move) > 1e-11) continue;
    if (std::abs(now - p) > 0.05) return {};
    if (now.imag() < 0.0) return ExceptionalPoint{std::conj(now), std::conj(at_now.mean)};
    return ExceptionalPoint{now, at_now.mean};
  }
  return {};
}

std::vector<ExceptionalPoint> exceptional_points(const Family& family, double from, double to, double reach) {
  std::vector<ExceptionalPoint> result;
  const auto add = [&](const ExceptionalPoint& found) {
    if (found.p.imag() > reach || found.p.real() < from || found.p.real() > to) return;
    // Mirror images about the real axis of s, at the same p, are one.
    const bool known = std::any_of(result.begin(), result.end(), [&](const ExceptionalPoint& other) {
      const double apart = std::min(std::abs(other.s - found.s), std::abs(std::conj(other.s) - found.s));
      return std::abs(other.p - found.p) < 1e-8 && apart < 1e-4 * std::abs(found.s);
    });
    if (!known) result.push_back(found);
  };
  const double half = half_window * (to - from);
  for (int i = 0; i < windows; ++i) {
    const double middle = from + (to - from) * (i + 0.5) / windows;
    const auto discriminant = [&](double x) { return spectrum_at(family, middle + half * x).values[D]; };
    for (const Complex root : chebyshev_roots(chebyshev_coefficients(discriminant, discriminant_degree))) {
      const Complex p = middle + half * root;
      const bool near = std::abs(root.real()) <= 0.8 && std::abs(root.imag()) * half <= 1.5 * reach;
      if (!near || root.imag() < -1e-3) continue;
      for (const Complex s : close_means(family, p)) {
        if (const auto found = corrected(family, p, s)) add(*found);
      }
    }
  }
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.p.real() < b.p.real(); });
  return result;
}

VeeringComparison compare_veerings(const Family& family, double from, double to,
                                   const std::vector<Event>& events) {
  const auto [low, high] = std::minmax(from, to);
  const double range = high - low;
  const auto found = exceptional_points(family, low, high, 1.001 * widest * range);
  const auto same = [&](Complex a, Complex b) { return std::abs(a - b) <= 1e-6 * range + 2e-3 * a.imag(); };
  VeeringComparison result;
  for (const ExceptionalPoint& point : found) {
    const bool counts = point.p.imag() > clear_of * range && point.p.imag() < 0.995 * widest * range &&
                        point.p.real() > low + 1e-6 * range && point.p.real() < high - 1e-6 * range;
    if (!counts) continue;
    const bool listed = std::any_of(events.begin(), events.end(), [&](const Event& event) {
      return event.kind == EventKind::veering && same(point.p, {event.p, event.half_width});
    });
    if (!listed) result.missing.push_back(describe("missing", point.p, point.s));
  }
  for (const Event& event : events) {
    if (event.kind != EventKind::veering) continue;
    const Complex p(event.p, event.half_width);
    const auto is_it = [&](const ExceptionalPoint& point) { return same(point.p, p); };
    if (std::any_of(found.begin(), found.end(), is_it)) continue;
    bool confirmed = false;
    for (const Complex start : {p, std::conj(p)}) {
      const auto point = corrected(family, start, event.s);
      confirmed = confirmed || (point && same(point->p, p));
    }
    if (!confirmed) result.invented.push_back(describe("invented", p, event.s));
  }
  return result;
}

}  // namespace eigentrail::test
