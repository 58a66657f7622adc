// Real polynomials in extended precision, for special points in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hard_cases/wide_pencil.hpp"

namespace eigentrail::test {

/// Coefficients of powers, lowest first; never empty.
struct Polynomial {
  std::vector<Wide> c{0};

  Polynomial() = default;
  Polynomial(Wide constant) : c{constant} {}  // NOLINT: numbers are polynomials
  explicit Polynomial(std::vector<Wide> coefficients) : c(std::move(coefficients)) {}

  template <class Scalar>
  Scalar operator()(Scalar p) const {
    Scalar value(0);
    for (std::size_t k = c.size(); k-- > 0;) value = value * p + Scalar(c[k]);
    return value;
  }
  bool is_constant() const {
    return std::all_of(c.begin() + 1, c.end(), [](Wide value) { return value == 0; });
  }
};

/// p - root.
inline Polynomial from_root(Wide root) {
  return Polynomial(std::vector<Wide>{-root, 1});
}

inline Polynomial operator+(const Polynomial& a, const Polynomial& b) {
  Polynomial sum(std::vector<Wide>(std::max(a.c.size(), b.c.size()), 0));
  for (std::size_t k = 0; k < a.c.size(); ++k) sum.c[k] += a.c[k];
  for (std::size_t k = 0; k < b.c.size(); ++k) sum.c[k] += b.c[k];
  return sum;
}

inline Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(std::vector<Wide>(a.c.size() + b.c.size() - 1, 0));
  for (std::size_t i = 0; i < a.c.size(); ++i) {
    for (std::size_t j = 0; j < b.c.size(); ++j) product.c[i + j] += a.c[i] * b.c[j];
  }
  return product;
}

inline Polynomial operator-(const Polynomial& a, const Polynomial& b) {
  return a + Polynomial(-1) * b;
}

inline bool operator==(const Polynomial& a, const Polynomial& b) {
  const Polynomial difference = a - b;
  return std::all_of(difference.c.begin(), difference.c.end(), [](Wide value) { return value == 0; });
}

inline Polynomial derivative(const Polynomial& a) {
  Polynomial result(std::vector<Wide>(std::max<std::size_t>(1, a.c.size() - 1), 0));
  for (std::size_t k = 1; k < a.c.size(); ++k) result.c[k - 1] = static_cast<Wide>(k) * a.c[k];
  return result;
}

/// Real roots in [low, high] where the polynomial changes its sign, ascending: bisection between the roots of
/// the derivative.
inline std::vector<Wide> real_roots(const Polynomial& a, Wide low, Wide high) {
  if (a.is_constant()) return {};
  std::vector<Wide> ends{low};
  for (const Wide turn : real_roots(derivative(a), low, high)) ends.push_back(turn);
  ends.push_back(high);
  std::vector<Wide> roots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    Wide left = ends[i];
    Wide right = ends[i + 1];
    const bool rising = a(left) < 0;
    if (rising == (a(right) < 0)) continue;
    while (true) {
      const Wide middle = (left + right) / 2;
      if (middle <= left || middle >= right) break;
      ((a(middle) < 0) == rising ? left : right) = middle;
    }
    roots.push_back((left + right) / 2);
  }
  return roots;
}

/// Both roots of a linear or quadratic polynomial with complex coefficients, without cancellation.
inline std::vector<WideComplex> roots_of_quadratic(WideComplex constant, WideComplex linear,
                                                   WideComplex square) {
  if (square == WideComplex(0)) return {-constant / linear};
  WideComplex root = std::sqrt(linear * linear - Wide(4) * square * constant);
  if ((std::conj(linear) * root).real() < 0) root = -root;
  const WideComplex q = -(linear + root) / Wide(2);
  if (q == WideComplex(0)) return {WideComplex(0), WideComplex(0)};
  return {q / square, constant / q};
}

}  // namespace eigentrail::test
