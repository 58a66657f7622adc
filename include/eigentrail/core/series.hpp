// Truncated power series: eigentrail computes all derivatives with them.
//
// Series<T, Q> holds the coefficients of c0 + c1 h + ... + cQ h^Q over a ring T and computes with them
// exactly up to the truncation (Griewank & Walther, Evaluating Derivatives, 2nd ed., Sect. 13.2).
//
//   * Series<double, Q>              a quantity along the path, h = distance along the path;
//   * Series<Series<double, Q>, 1>   the same with one directional derivative: coefficient 1 is d/dx_i, which
//     is again a series along the path;
//   * one more level of nesting      second derivatives (constraint curvature).
//
// A physics function that is written once, as a template over its scalar type, thus yields its value, its
// Jacobian and the derivatives of both along the path.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <type_traits>

namespace eigentrail {

/// A truncated power series with coefficients of type T up to h^Order.
template <class T, int Order>
class Series {
 public:
  static_assert(Order >= 0);
  using Coefficient = T;
  static constexpr int order = Order;

  Series() = default;
  Series(double constant) { c_[0] = T(constant); }  // NOLINT: numbers are constant series
  Series(const T& constant)                         // NOLINT: likewise
      requires(!std::is_same_v<T, double>) {
    c_[0] = constant;
  }

  /// Coefficient of h^k, 0 <= k <= Order.
  T& operator[](int k) { return c_[k]; }
  const T& operator[](int k) const { return c_[k]; }

  Series& operator+=(const Series& b) {
    for (int k = 0; k <= Order; ++k) c_[k] += b[k];
    return *this;
  }
  Series& operator-=(const Series& b) {
    for (int k = 0; k <= Order; ++k) c_[k] -= b[k];
    return *this;
  }
  Series& operator*=(const Series& b) { return *this = *this * b; }
  Series& operator/=(const Series& b) { return *this = *this / b; }
  Series& operator*=(double b) {
    for (T& c : c_) c *= b;
    return *this;
  }

  friend Series operator+(Series a, const Series& b) { return a += b; }
  friend Series operator-(Series a, const Series& b) { return a -= b; }
  friend Series operator-(Series a) { return a *= -1.0; }
  friend Series operator*(Series a, double b) { return a *= b; }
  friend Series operator*(double a, Series b) { return b *= a; }

  friend Series operator*(const Series& a, const Series& b) {
    Series product;
    for (int i = 0; i <= Order; ++i) {
      for (int j = 0; i + j <= Order; ++j) product[i + j] += a[i] * b[j];
    }
    return product;
  }

  /// Quotient from a = q b: q_k = (a_k - sum_{j<k} q_j b_{k-j}) / b_0.
  friend Series operator/(const Series& a, const Series& b) {
    Series quotient;
    for (int k = 0; k <= Order; ++k) {
      T rest = a[k];
      for (int j = 0; j < k; ++j) rest -= quotient[j] * b[k - j];
      quotient[k] = rest / b[0];
    }
    return quotient;
  }

 private:
  std::array<T, Order + 1> c_{};
};

namespace detail {

/// The function y(h) with y(0) = y0 and dy/dh = g dx/dh: k y_k = sum_{j=1..k} j x_j g_{k-j}. Coefficient k
/// needs g only up to k-1, so g may depend on y: `rate(y, k)` returns g_k and may use y_0..y_k.
template <class T, int Q, class Rate>
Series<T, Q> integrate(const T& y0, const Series<T, Q>& x, Rate rate) {
  Series<T, Q> y(y0), g;
  for (int k = 1; k <= Q; ++k) {
    g[k - 1] = rate(y, k - 1);
    for (int j = 1; j <= k; ++j) y[k] += (double(j) / k) * (x[j] * g[k - j]);
  }
  return y;
}

/// The same if g is known as a series beforehand.
template <class T, int Q>
Series<T, Q> integrate(const T& y0, const Series<T, Q>& x, const Series<T, Q>& g) {
  return integrate(y0, x, [&g](const Series<T, Q>&, int k) { return g[k]; });
}

/// Sine and cosine (sign = -1) or hyperbolic sine and cosine (sign = +1) together, because each recursion
/// needs the other. s0 and c0 are the values at x_0.
template <class T, int Q>
std::array<Series<T, Q>, 2> sine_cosine(const T& s0, const T& c0, const Series<T, Q>& x, double sign) {
  Series<T, Q> s(s0), c(c0);
  for (int k = 1; k <= Q; ++k) {
    for (int j = 1; j <= k; ++j) {
      const double w = double(j) / k;
      s[k] += w * (x[j] * c[k - j]);
      c[k] += (sign * w) * (x[j] * s[k - j]);
    }
  }
  return {s, c};
}

}  // namespace detail

/// Square root. If x_0 = 0 there is no power series; the coefficients are then not finite, and the assembly
/// reports it.
template <class T, int Q>
Series<T, Q> sqrt(const Series<T, Q>& x) {
  using std::sqrt;
  Series<T, Q> y(T(sqrt(x[0])));
  for (int k = 1; k <= Q; ++k) {
    T rest = x[k];
    for (int j = 1; j < k; ++j) rest -= y[j] * y[k - j];
    y[k] = rest / (2.0 * y[0]);
  }
  return y;
}

template <class T, int Q>
Series<T, Q> exp(const Series<T, Q>& x) {
  using std::exp;
  return detail::integrate(T(exp(x[0])), x, [](const Series<T, Q>& y, int k) { return y[k]; });
}

template <class T, int Q>
Series<T, Q> log(const Series<T, Q>& x) {
  using std::log;
  return detail::integrate(T(log(x[0])), x, Series<T, Q>(1.0) / x);
}

template <class T, int Q>
Series<T, Q> sin(const Series<T, Q>& x) {
  using std::cos;
  using std::sin;
  return detail::sine_cosine(T(sin(x[0])), T(cos(x[0])), x, -1.0)[0];
}

template <class T, int Q>
Series<T, Q> cos(const Series<T, Q>& x) {
  using std::cos;
  using std::sin;
  return detail::sine_cosine(T(sin(x[0])), T(cos(x[0])), x, -1.0)[1];
}

template <class T, int Q>
Series<T, Q> tan(const Series<T, Q>& x) {
  return sin(x) / cos(x);
}

template <class T, int Q>
Series<T, Q> sinh(const Series<T, Q>& x) {
  using std::cosh;
  using std::sinh;
  return detail::sine_cosine(T(sinh(x[0])), T(cosh(x[0])), x, 1.0)[0];
}

template <class T, int Q>
Series<T, Q> cosh(const Series<T, Q>& x) {
  using std::cosh;
  using std::sinh;
  return detail::sine_cosine(T(sinh(x[0])), T(cosh(x[0])), x, 1.0)[1];
}

template <class T, int Q>
Series<T, Q> tanh(const Series<T, Q>& x) {
  using std::tanh;
  // From y' = (1 - y^2) x', because sinh and cosh overflow for large |x|, where tanh is close to one.
  return detail::integrate(T(tanh(x[0])), x, [](const Series<T, Q>& y, int k) {
    T rate = k == 0 ? T(1.0) : T(0.0);
    for (int i = 0; i <= k; ++i) rate -= y[i] * y[k - i];
    return rate;
  });
}

template <class T, int Q>
Series<T, Q> asin(const Series<T, Q>& x) {
  using std::asin;
  return detail::integrate(T(asin(x[0])), x, 1.0 / sqrt(1.0 - x * x));
}

template <class T, int Q>
Series<T, Q> acos(const Series<T, Q>& x) {
  using std::acos;
  return detail::integrate(T(acos(x[0])), x, -1.0 / sqrt(1.0 - x * x));
}

template <class T, int Q>
Series<T, Q> atan(const Series<T, Q>& x) {
  using std::atan;
  return detail::integrate(T(atan(x[0])), x, 1.0 / (1.0 + x * x));
}

/// The leading coefficient of a series as a double; for nested series, that of the innermost one.
template <class Number>
double leading_value(const Number& x) {
  return static_cast<double>(x);
}
template <class T, int Q>
double leading_value(const Series<T, Q>& x) {
  return leading_value(x[0]);
}

/// Angle (rad) of the vector (cosine, sine), which may have any positive length. The branch is that of
/// std::atan2 at the leading values. The vector is first rotated back by the leading angle, so that the
/// argument of atan has a small leading value.
template <class Scalar>
Scalar angle_of(const Scalar& sine, const Scalar& cosine) {
  using std::atan, std::cos, std::sin;
  const Scalar turn(std::atan2(leading_value(sine), leading_value(cosine)));
  const Scalar c = cos(turn);
  const Scalar s = sin(turn);
  return turn + atan((sine * c - cosine * s) / (cosine * c + sine * s));
}

/// x^n for an integer n by repeated squaring. Exact also at x_0 = 0, where exp(n log x) is undefined.
template <class Scalar>
Scalar integer_power(Scalar base, int n) {
  if (n < 0) return Scalar(1.0) / integer_power(base, -n);
  Scalar power(1.0);
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) power = power * base;
    if (n > 1) base = base * base;
  }
  return power;
}

namespace detail {

template <class T>
inline constexpr bool is_series = false;
template <class T, int Q>
inline constexpr bool is_series<Series<T, Q>> = true;

}  // namespace detail

/// x^y for x_0 > 0.
template <class T, int Q>
Series<T, Q> pow(const Series<T, Q>& x, const Series<T, Q>& y) {
  return exp(y * log(x));
}

/// The same for series with numbers as coefficients. If y is a constant integer with |y| <= 64 it holds for
/// every x_0, like std::pow.
template <class T, int Q>
requires(!detail::is_series<T>) Series<T, Q> pow(const Series<T, Q>& x, const Series<T, Q>& y) {
  using std::abs, std::floor;
  bool constant = true;
  for (int k = 1; k <= Q; ++k) constant = constant && y[k] == T(0.0);
  if (constant && y[0] == floor(y[0]) && abs(y[0]) <= T(64.0))
    return integer_power(x, static_cast<int>(static_cast<double>(y[0])));
  return exp(y * log(x));
}

}  // namespace eigentrail

// Traits that make Series an Eigen scalar, so that elements can use Eigen's small vectors.
template <class T, int Q>
struct Eigen::NumTraits<eigentrail::Series<T, Q>> : Eigen::GenericNumTraits<double> {
  using Real = eigentrail::Series<T, Q>;
  using NonInteger = eigentrail::Series<T, Q>;
  using Nested = eigentrail::Series<T, Q>;
  using Literal = double;
  enum { RequireInitialization = 1, ReadCost = Q + 1, AddCost = Q + 1, MulCost = (Q + 1) * (Q + 2) / 2 };
};
template <class T, int Q, class Operation>
struct Eigen::ScalarBinaryOpTraits<eigentrail::Series<T, Q>, double, Operation> {
  using ReturnType = eigentrail::Series<T, Q>;
};
template <class T, int Q, class Operation>
struct Eigen::ScalarBinaryOpTraits<double, eigentrail::Series<T, Q>, Operation> {
  using ReturnType = eigentrail::Series<T, Q>;
};
