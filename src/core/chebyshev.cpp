#include "eigentrail/core/chebyshev.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

/// Leading coefficients below this fraction of the largest are rounding: dividing by them would spoil all
/// roots.
constexpr double negligible = 1e-13;

Eigen::Index significant(const ComplexVector& coefficients) {
  const double largest = coefficients.cwiseAbs().maxCoeff();
  Eigen::Index top = coefficients.size() - 1;
  while (top > 0 && !(std::abs(coefficients[top]) > negligible * largest)) --top;
  return top;
}

/// Newton's method on sum_k c_k T_k(u) as long as it makes the value smaller: a matrix with a small leading
/// coefficient in its denominators tells roots poorly.
Complex polish(const ComplexVector& c, Complex u) {
  constexpr int corrections = 4;
  const auto evaluate = [&c](Complex at, Complex& slope) {
    Complex before = 1.0;  // T_0, T_1 and their derivatives
    Complex current = at;
    Complex slope_before = 0.0;
    Complex slope_current = 1.0;
    Complex value = c[0] + (c.size() > 1 ? c[1] * at : Complex(0.0));
    slope = c.size() > 1 ? c[1] : Complex(0.0);
    for (Eigen::Index k = 2; k < c.size(); ++k) {
      const Complex next = 2.0 * at * current - before;
      const Complex slope_next = 2.0 * current + 2.0 * at * slope_current - slope_before;
      before = current;
      current = next;
      slope_before = slope_current;
      slope_current = slope_next;
      value += c[k] * current;
      slope += c[k] * slope_current;
    }
    return value;
  };
  Complex slope;
  Complex value = evaluate(u, slope);
  for (int i = 0; i < corrections && slope != 0.0; ++i) {
    const Complex next = u - value / slope;
    Complex next_slope;
    const Complex next_value = evaluate(next, next_slope);
    if (!(std::abs(next_value) < std::abs(value))) break;
    u = next;
    value = next_value;
    slope = next_slope;
  }
  return u;
}

std::vector<Complex> eigenvalues(const ComplexMatrix& matrix) {
  const ComplexVector values = Eigen::ComplexEigenSolver<ComplexMatrix>(matrix, false).eigenvalues();
  return {values.begin(), values.end()};
}

}  // namespace

ComplexVector chebyshev_coefficients(const std::function<Complex(double)>& f, int degree) {
  const Eigen::Index count = degree + 1;
  ComplexVector coefficients = ComplexVector::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const Complex value = f(0.5 * (1.0 + std::cos(angle)));
    for (Eigen::Index k = 0; k < count; ++k)
      coefficients[k] += value * std::cos(static_cast<double>(k) * angle);
  }
  coefficients *= 2.0 / static_cast<double>(count);
  coefficients[0] *= 0.5;
  return coefficients;
}

std::vector<Complex> chebyshev_roots(const ComplexVector& coefficients) {
  if (!coefficients.allFinite()) return {};
  const Eigen::Index top = significant(coefficients);
  if (top == 0) return {};
  ComplexMatrix colleague = ComplexMatrix::Zero(top, top);
  for (Eigen::Index k = 0; k < top; ++k) {
    if (k > 0) colleague(k, k - 1) = 0.5;
    if (k + 1 < top) colleague(k, k + 1) = k == 0 ? 1.0 : 0.5;
  }
  // u T_{n-1} = (T_n + T_{n-2}) / 2, with T_n replaced through the polynomial itself.
  const double factor = top == 1 ? 1.0 : 0.5;
  for (Eigen::Index k = 0; k < top; ++k)
    colleague(top - 1, k) -= factor * coefficients[k] / coefficients[top];
  std::vector<Complex> roots = eigenvalues(colleague);
  const ComplexVector kept = coefficients.head(top + 1);
  for (Complex& root : roots) root = 0.5 * (1.0 + polish(kept, root));
  return roots;
}

std::vector<Complex> polynomial_roots(const ComplexVector& coefficients) {
  if (!coefficients.allFinite()) return {};
  const Eigen::Index top = significant(coefficients);
  if (top == 0) return {};
  ComplexMatrix companion = ComplexMatrix::Zero(top, top);
  companion.bottomLeftCorner(top - 1, top - 1).setIdentity();
  companion.col(top - 1) = -coefficients.head(top) / coefficients[top];
  return eigenvalues(companion);
}

bool has_no_root_within(const ComplexVector& coefficients, double radius) {
  double others = 0.0;
  double power = 1.0;
  for (Eigen::Index k = 1; k < coefficients.size(); ++k)
    others += std::abs(coefficients[k]) * (power *= radius);
  return std::abs(coefficients[0]) > others;
}

}  // namespace eigentrail
