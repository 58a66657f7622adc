// Intervals of real numbers, as coefficients of Series: enclosures of functions and of their derivatives over
// a range of parameters. Rounding is not directed outwards: they serve to find where a function changes, not
// to prove bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace eigentrail {

struct Interval {
  double lower = 0.0, upper = 0.0;

  Interval() = default;
  Interval(double value) : lower(value), upper(value) {}  // NOLINT: numbers are intervals
  Interval(double from, double to) : lower(from), upper(to) {}

  static Interval all() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  bool is_finite() const { return std::isfinite(lower) && std::isfinite(upper); }
  /// The middle.
  explicit operator double() const { return 0.5 * (lower + upper); }
  double magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }

  friend bool operator<=(const Interval& a, const Interval& b) { return a.upper <= b.lower; }
  friend bool operator==(const Interval& a, const Interval& b) = default;
  Interval& operator+=(const Interval& b) { return *this = *this + b; }
  Interval& operator-=(const Interval& b) { return *this = *this - b; }
  Interval& operator*=(const Interval& b) { return *this = *this * b; }

  friend Interval operator+(const Interval& a, const Interval& b) {
    return {a.lower + b.lower, a.upper + b.upper};
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return {a.lower - b.upper, a.upper - b.lower};
  }
  friend Interval operator-(const Interval& a) { return {-a.upper, -a.lower}; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const double p = product(a.lower, b.lower), q = product(a.lower, b.upper);
    const double r = product(a.upper, b.lower), s = product(a.upper, b.upper);
    return {std::min({p, q, r, s}), std::max({p, q, r, s})};
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (b.lower <= 0.0 && b.upper >= 0.0) return all();
    return a * Interval{1.0 / b.upper, 1.0 / b.lower};
  }

 private:
  /// Zero times infinity is zero: an unknown factor of nothing.
  static double product(double a, double b) { return a == 0.0 || b == 0.0 ? 0.0 : a * b; }
};

/// The image under an increasing function.
Interval increasing(const Interval& x, auto f) {
  return {f(x.lower), f(x.upper)};
}

inline Interval floor(const Interval& x) {
  return increasing(x, [](double t) { return std::floor(t); });
}
inline Interval abs(const Interval& x) {
  return {x.lower <= 0.0 && x.upper >= 0.0 ? 0.0 : std::min(std::abs(x.lower), std::abs(x.upper)),
          x.magnitude()};
}
inline Interval exp(const Interval& x) {
  return increasing(x, [](double t) { return std::exp(t); });
}
inline Interval sinh(const Interval& x) {
  return increasing(x, [](double t) { return std::sinh(t); });
}
inline Interval tanh(const Interval& x) {
  return increasing(x, [](double t) { return std::tanh(t); });
}
inline Interval atan(const Interval& x) {
  return increasing(x, [](double t) { return std::atan(t); });
}
inline Interval log(const Interval& x) {
  return x.lower > 0.0 ? increasing(x, [](double t) { return std::log(t); }) : Interval::all();
}
inline Interval sqrt(const Interval& x) {
  return x.lower > 0.0 ? increasing(x, [](double t) { return std::sqrt(t); }) : Interval::all();
}
inline Interval asin(const Interval& x) {
  return x.magnitude() < 1.0 ? increasing(x, [](double t) { return std::asin(t); }) : Interval::all();
}
inline Interval acos(const Interval& x) {
  if (!(x.magnitude() < 1.0)) return Interval::all();
  return {std::acos(x.upper), std::acos(x.lower)};
}
inline Interval cosh(const Interval& x) {
  return increasing(abs(x), [](double t) { return std::cosh(t); });
}
inline Interval cos(const Interval& x) {
  if (!(x.upper - x.lower < 2.0 * std::numbers::pi)) return {-1.0, 1.0};
  // The multiples of pi on the interval are the places of the extrema.
  const double first = std::ceil(x.lower / std::numbers::pi);
  const double last = std::floor(x.upper / std::numbers::pi);
  const double a = std::cos(x.lower), b = std::cos(x.upper);
  Interval range{std::min(a, b), std::max(a, b)};
  for (double k = first; k <= last; k += 1.0) {
    if (std::fmod(k, 2.0) == 0.0) {
      range.upper = 1.0;
    } else {
      range.lower = -1.0;
    }
  }
  return range;
}
inline Interval sin(const Interval& x) {
  return cos(x - Interval(0.5 * std::numbers::pi));
}

}  // namespace eigentrail
