#include "continuation/events/exceptional_point.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/core/complex_lu.hpp"

namespace eigentrail {
namespace {

/// Newton iterations: from the prediction a few, close to another exceptional point linear convergence first.
constexpr int most_iterations = 30;
/// Relative size of the last move of h and of mu.
constexpr double settled = 1e-12;
/// Steps of the way down to the real axis: first share of it, and least one.
constexpr double first_share = 0.02;
constexpr double least_share = 1e-4;
/// Largest growth of a step on that way.
constexpr double growth = 1.6;
/// An eigenvalue counts as followed if its correction is at most this share of its distance from the other
/// one, and of what it moved.
constexpr double certain = 0.2;

/// A matrix series and its derivatives at a complex place.
struct Jet {
  ComplexMatrix value, slope, curvature;
};

Jet jet_of(const MatrixSeries& series, Complex h) {
  const Eigen::Index n = series[0].rows();
  Jet jet{ComplexMatrix::Zero(n, n), ComplexMatrix::Zero(n, n), ComplexMatrix::Zero(n, n)};
  for (std::size_t k = series.size(); k-- > 0;) {
    jet.curvature = h * jet.curvature + 2.0 * jet.slope;
    jet.slope = h * jet.slope + jet.value;
    jet.value = h * jet.value;
    jet.value += series[k].cast<Complex>();
  }
  return jet;
}

/// P(mu, h) = mu^2 A + mu B + C with its derivatives.
class PencilAt {
 public:
  PencilAt(const ReducedPencil& pencil, Chart chart, Complex h)
      : second_(jet_of(chart == Chart::finite ? pencil.M : pencil.K, h)),
        first_(jet_of(pencil.C, h)),
        zeroth_(jet_of(chart == Chart::finite ? pencil.K : pencil.M, h)) {}

  ComplexMatrix value(Complex mu) const {
    return mu * mu * second_.value + mu * first_.value + zeroth_.value;
  }
  ComplexVector by_mu(Complex mu, const ComplexVector& v) const {
    return 2.0 * mu * (second_.value * v) + first_.value * v;
  }
  ComplexVector by_mu_twice(const ComplexVector& v) const { return 2.0 * (second_.value * v); }
  ComplexVector by_h(Complex mu, const ComplexVector& v) const {
    return mu * mu * (second_.slope * v) + mu * (first_.slope * v) + zeroth_.slope * v;
  }
  ComplexVector by_h_twice(Complex mu, const ComplexVector& v) const {
    return mu * mu * (second_.curvature * v) + mu * (first_.curvature * v) + zeroth_.curvature * v;
  }
  ComplexVector by_both(Complex mu, const ComplexVector& v) const {
    return 2.0 * mu * (second_.slope * v) + first_.slope * v;
  }

 private:
  Jet second_, first_, zeroth_;
};

/// The bordered system at one place, with borders that are renewed from solution to solution.
class Bordered {
 public:
  explicit Bordered(Eigen::Index n) : b_(n), c_(n) {
    // Without symmetry, so that they are not orthogonal to the vectors that are wanted.
    for (Eigen::Index i = 0; i < n; ++i) {
      b_[i] = Complex(1.0, std::sin(1.0 + 2.3 * static_cast<double>(i)));
      c_[i] = Complex(std::cos(0.7 + 1.9 * static_cast<double>(i)), 1.0);
    }
    b_.normalize();
    c_.normalize();
  }

  /// g, g_mu, g_h, g_mumu, g_muh, g_hh.
  struct Values {
    Complex g, mu, h, mumu, muh, hh;
  };

  Values at(const PencilAt& pencil, Complex mu) {
    const Eigen::Index n = b_.size();
    ComplexMatrix B(n + 1, n + 1);
    B << pencil.value(mu), b_, c_.adjoint(), ComplexMatrix::Zero(1, 1);
    const ComplexLu lu(std::move(B));
    ComplexVector right = ComplexVector::Unit(n + 1, n);
    ComplexVector left = right;
    lu.solve_in_place(right);
    lu.solve_adjoint_in_place(left);
    v_ = right.head(n);
    const ComplexVector w = left.head(n);
    const ComplexVector P_mu = pencil.by_mu(mu, v_), P_h = pencil.by_h(mu, v_);
    const auto change = [&](const ComplexVector& P_x) {
      ComplexVector x = ComplexVector::Zero(n + 1);
      x.head(n) = -P_x;
      lu.solve_in_place(x);
      return ComplexVector(x.head(n));
    };
    const ComplexVector v_mu = change(P_mu), v_h = change(P_h);
    Values values;
    values.g = right[n];
    values.mu = -w.dot(P_mu);
    values.h = -w.dot(P_h);
    values.mumu = -w.dot(pencil.by_mu_twice(v_)) - 2.0 * w.dot(pencil.by_mu(mu, v_mu));
    values.muh = -w.dot(pencil.by_both(mu, v_)) - w.dot(pencil.by_mu(mu, v_h)) - w.dot(pencil.by_h(mu, v_mu));
    values.hh = -w.dot(pencil.by_h_twice(mu, v_)) - 2.0 * w.dot(pencil.by_h(mu, v_h));
    if (v_.allFinite() && w.allFinite() && v_.norm() > 0.0 && w.norm() > 0.0) {
      c_ = v_.normalized();
      b_ = w.normalized();
    }
    return values;
  }

  ComplexVector vector() const { return v_.normalized(); }

 private:
  ComplexVector b_, c_, v_;
};

bool is_finite(Complex z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

/// A root mu of g at fixed h by Newton's method; empty if it does not settle. `moved`: largest allowed way.
std::optional<Complex> root_at(const PencilAt& pencil, Complex mu, double moved, Bordered& bordered) {
  const Complex start = mu;
  for (int i = 0; i < most_iterations; ++i) {
    const auto values = bordered.at(pencil, mu);
    const Complex move = -values.g / values.mu;
    if (!is_finite(move)) return std::nullopt;
    mu += move;
    if (std::abs(mu - start) > moved) return std::nullopt;
    if (std::abs(move) <= settled * std::abs(mu)) return mu;
  }
  return std::nullopt;
}

/// The place between two close eigenvalues where g_mu vanishes, from a place near it. The borders come to
/// belong to the two.
Complex between_eigenvalues(const PencilAt& pencil, Complex mu, Bordered& bordered) {
  constexpr int rounds = 4;         // g is about a parabola in mu, so that one would do with good borders
  constexpr double farthest = 0.2;  // of mu, from the start: beyond that it is between others
  bordered.at(pencil, mu);          // with borders that belong to nothing yet
  const Complex start = mu;
  for (int i = 0; i < rounds; ++i) {
    const auto g = bordered.at(pencil, mu);
    const Complex next = mu - g.mu / g.mumu;
    if (!is_finite(next) || std::abs(next - start) > farthest * std::abs(start)) return start;
    mu = next;
  }
  return mu;
}

}  // namespace

std::optional<ExceptionalPoint> find_exceptional_point(const ReducedPencil& pencil, Chart chart, Complex h,
                                                       Complex mu, double reach,
                                                       const std::vector<Complex>& known) {
  Bordered bordered(pencil.size());
  const Complex start = h;
  const double size_of_mu = std::abs(mu);
  mu = between_eigenvalues(PencilAt(pencil, chart, h), mu, bordered);
  for (int i = 0; i < most_iterations; ++i) {
    const auto g = bordered.at(PencilAt(pencil, chart, h), mu);
    // [g_mu g_h; g_mumu g_muh] [dmu; dh] = -[g; g_mu]
    const Complex determinant = g.mu * g.muh - g.h * g.mumu;
    Complex dh = (g.mumu * g.g - g.mu * g.mu) / determinant;
    Complex repelled = 0.0;
    for (const Complex other : known) repelled += 1.0 / (h - other);
    dh /= 1.0 + dh * repelled;
    Complex dmu = (-g.mu - g.muh * dh) / g.mumu;
    if (!is_finite(dh) || !is_finite(dmu)) return std::nullopt;
    const double too_far = std::max(std::abs(dh) / (0.5 * reach), std::abs(dmu) / (0.5 * size_of_mu));
    if (too_far > 1.0) {
      dh /= too_far;
      dmu /= too_far;
    }
    h += dh;
    mu += dmu;
    if (std::abs(h - start) > reach) return std::nullopt;
    if (!(std::abs(dh) <= settled * reach && std::abs(dmu) <= std::sqrt(settled) * size_of_mu)) continue;
    const Complex curvature = g.hh - g.muh * g.muh / g.mumu;
    return ExceptionalPoint{h, mu, -2.0 * g.h / g.mumu, h - 2.0 * g.h / curvature};
  }
  return std::nullopt;
}

std::optional<Complex> mean_at(const ReducedPencil& pencil, Chart chart, double from, Complex h,
                               std::array<Complex, 2> mu) {
  constexpr double first_way = 0.125;
  constexpr double least_way = 1e-3;
  constexpr double enough = 0.9;  // of the way: close to an exceptional point only the mean is smooth
  std::array<Bordered, 2> bordered{Bordered(pencil.size()), Bordered(pencil.size())};
  const Complex way = h - from;
  std::array<Complex, 2> slope{};
  double share = 0.0, step = 0.0;
  const auto go_to = [&](double next) {
    const PencilAt here(pencil, chart, from + next * way);
    const std::array<Complex, 2> before = mu;
    std::array<Complex, 2> slope_there{};
    for (std::size_t k = 0; k < 2; ++k) {
      const Complex predicted = before[k] + (next - share) * slope[k];
      bordered[k].at(here, predicted);
      const auto root = root_at(here, predicted, certain * std::abs(before[0] - before[1]), bordered[k]);
      if (!root) {
        mu = before;
        return false;
      }
      mu[k] = *root;
      const auto g = bordered[k].at(here, mu[k]);
      slope_there[k] = -g.h / g.mu * way;
    }
    slope = slope_there;
    share = next;
    return true;
  };
  if (!go_to(0.0)) return std::nullopt;
  step = first_way;
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
  std::array<Bordered, 2> bordered{Bordered(pencil.size()), Bordered(pencil.size())};
  const Complex down(0.0, -point.h.imag());
  const auto apart = [&](double share) { return std::sqrt(point.slope * share * down); };
  double share = first_share, step = first_share;
  std::array<Complex, 2> mu{point.mu + apart(share), point.mu - apart(share)}, before{point.mu, point.mu};
  double before_share = 0.0;
  bool at_start = true;
  while (true) {
    const PencilAt here(pencil, chart, point.h + share * down);
    std::array<Complex, 2> found{};
    bool followed = true;
    for (std::size_t k = 0; k < 2 && followed; ++k) {
      const double other = std::abs(mu[0] - mu[1]);
      bordered[k].at(here, mu[k]);
      const auto root = root_at(here, mu[k], (at_start ? 0.5 : certain) * other, bordered[k]);
      followed = root.has_value();
      if (followed) found[k] = *root;
    }
    if (!followed) {
      if (at_start && share > least_share * first_share) {
        share *= 0.25;
        step = share;
        mu = {point.mu + apart(share), point.mu - apart(share)};
        continue;
      }
      step *= 0.5;
      if (at_start || step < least_share * before_share) return std::nullopt;
      share = before_share + step;
    } else {
      if (share >= 1.0) {
        return std::array<EigenvalueBelow, 2>{EigenvalueBelow{found[0], bordered[0].vector()},
                                              EigenvalueBelow{found[1], bordered[1].vector()}};
      }
      at_start = false;
      before = found;
      before_share = share;
      step = std::max(step, growth * step);
      share = std::min(1.0, share + step);
    }
    // The distance from the double eigenvalue grows like the square root of the way, at first.
    const double ratio = std::sqrt(share / before_share);
    for (std::size_t k = 0; k < 2; ++k) mu[k] = point.mu + ratio * (before[k] - point.mu);
  }
}

}  // namespace eigentrail
