#include "eigentrail/core/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/lapack.hpp"

namespace eigentrail {
namespace {

/// Leading coefficients below this fraction of the largest one are taken for rounding errors. Division by
/// such a coefficient would spoil all roots.
constexpr double negligible = 1e-13;

/// Index of the highest coefficient that counts as nonzero.
Eigen::Index significant(const ComplexVector& coefficients) {
  const double largest = coefficients.cwiseAbs().maxCoeff();
  Eigen::Index top = coefficients.size() - 1;
  while (top > 0 && !(std::abs(coefficients[top]) > negligible * largest)) --top;
  return top;
}

/// Eigenvalues u of A - u B by the QZ algorithm. A small leading coefficient of the polynomial appears in B
/// and does not spoil the eigenvalues, as a division by it would.
std::vector<Complex> finite_eigenvalues(ComplexMatrix A, ComplexMatrix B) {
  const auto n = static_cast<lapack_int>(A.rows());
  ComplexVector alpha(n);
  ComplexVector beta(n);
  const lapack_int info = LAPACKE_zggev(LAPACK_COL_MAJOR, 'N', 'N', n, A.data(), n, B.data(), n, alpha.data(),
                                        beta.data(), nullptr, 1, nullptr, 1);
  std::vector<Complex> values;
  for (lapack_int i = 0; info == 0 && i < n; ++i) {
    if (beta[i] != 0.0) values.push_back(alpha[i] / beta[i]);
  }
  return values;
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
  // Recurrence: u T_0 = T_1, u T_k = (T_{k-1} + T_{k+1}) / 2. In the last row the polynomial itself replaces
  // c_n T_n.
  ComplexMatrix colleague = ComplexMatrix::Zero(top, top);
  for (Eigen::Index k = 0; k < top; ++k) {
    if (k > 0) colleague(k, k - 1) = 0.5;
    if (k + 1 < top) colleague(k, k + 1) = k == 0 ? 1.0 : 0.5;
  }
  const double largest = coefficients.cwiseAbs().maxCoeff();
  const Complex leading = coefficients[top] / largest;
  const double factor = top == 1 ? 1.0 : 0.5;
  colleague.row(top - 1) *= leading;
  colleague.row(top - 1) -= factor / largest * coefficients.head(top).transpose();
  ComplexMatrix scale = ComplexMatrix::Identity(top, top);
  scale(top - 1, top - 1) = leading;
  std::vector<Complex> roots = finite_eigenvalues(std::move(colleague), std::move(scale));
  for (Complex& root : roots) root = 0.5 * (1.0 + root);
  return roots;
}

std::vector<Complex> polynomial_roots(const ComplexVector& coefficients) {
  if (!coefficients.allFinite()) return {};
  Eigen::Index zeros = 0, top = coefficients.size() - 1;
  while (top > 0 && coefficients[top] == 0.0) --top;
  while (zeros < top && coefficients[zeros] == 0.0) ++zeros;
  std::vector<Complex> roots(static_cast<std::size_t>(zeros), 0.0);
  if (top == zeros) return roots;
  // In the unit of about the smallest root no coefficient exceeds the first one: division by that does no
  // harm, and gives the reciprocals of the roots, the smallest roots most accurately.
  const Eigen::Index degree = top - zeros;
  double unit = INFINITY;
  for (Eigen::Index k = 1; k <= degree; ++k)
    unit = std::min(unit, std::pow(std::abs(coefficients[zeros] / coefficients[zeros + k]),
                                   1.0 / static_cast<double>(k)));
  const auto size = static_cast<lapack_int>(degree);
  ComplexMatrix companion = ComplexMatrix::Zero(degree, degree);
  companion.bottomLeftCorner(degree - 1, degree - 1).setIdentity();
  for (Eigen::Index k = 1; k <= degree; ++k)
    companion(degree - k, degree - 1) =
        -coefficients[zeros + k] / coefficients[zeros] * std::pow(unit, static_cast<double>(k));
  ComplexVector reciprocals(degree);
  // It balances the matrix first: roots of very different size are as accurate as their coefficients.
  if (LAPACKE_zgeev(LAPACK_COL_MAJOR, 'N', 'N', size, companion.data(), size, reciprocals.data(), nullptr, 1,
                    nullptr, 1) != 0)
    return {};
  for (const Complex reciprocal : reciprocals) {
    if (reciprocal != 0.0) roots.push_back(unit / reciprocal);
  }
  return roots;
}

bool has_no_root_within(const ComplexVector& coefficients, double radius) {
  double others = 0.0;
  double power = 1.0;
  for (Eigen::Index k = 1; k < coefficients.size(); ++k)
    others += std::abs(coefficients[k]) * (power *= radius);
  return std::abs(coefficients[0]) > others;
}

namespace {

/// Coefficients of the same polynomial in powers of h - to, by Horner's scheme.
ComplexVector shifted(ComplexVector coefficients, Complex to) {
  for (Eigen::Index begin = 0; begin + 1 < coefficients.size(); ++begin) {
    for (Eigen::Index k = coefficients.size() - 1; k-- > begin;) coefficients[k] += to * coefficients[k + 1];
  }
  return coefficients;
}

/// `discs` is the number of discs that may still be tried; each call uses one.
bool excludes_roots(const ComplexVector& coefficients, const Rectangle& rectangle, int& discs) {
  if (--discs < 0) return false;
  const double radius = std::hypot(rectangle.half_width, rectangle.half_height);
  if (has_no_root_within(shifted(coefficients, rectangle.center), radius)) return true;
  // Bisect the rectangle across its longer side and test both halves.
  const bool wide = rectangle.half_width > rectangle.half_height;
  Rectangle half = rectangle;
  (wide ? half.half_width : half.half_height) *= 0.5;
  const Complex offset = wide ? Complex(half.half_width) : Complex(0.0, half.half_height);
  for (const Complex center : {rectangle.center - offset, rectangle.center + offset}) {
    half.center = center;
    if (!excludes_roots(coefficients, half, discs)) return false;
  }
  return true;
}

/// Coefficients in powers of u of sum_k c_k T_k(u).
ComplexVector in_powers(const ComplexVector& chebyshev) {
  const Eigen::Index n = chebyshev.size();
  ComplexVector powers = ComplexVector::Zero(n);
  Vector before = Vector::Zero(n);
  Vector here = Vector::Unit(n, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    powers += chebyshev[k] * here;
    // T_1 = u T_0, T_k+1 = 2 u T_k - T_k-1
    Vector next = -before;
    next.tail(n - 1) += (k == 0 ? 1.0 : 2.0) * here.head(n - 1);
    before = std::exchange(here, std::move(next));
  }
  return powers;
}

}  // namespace

bool has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle) {
  // At most 40 discs: a limit on the cost, not on correctness.
  int discs = 40;
  return excludes_roots(coefficients, rectangle, discs);
}

bool chebyshev_has_no_root_in(const ComplexVector& coefficients, const Rectangle& rectangle) {
  return has_no_root_in(in_powers(coefficients), {2.0 * rectangle.center - 1.0, 2.0 * rectangle.half_width,
                                                  2.0 * rectangle.half_height});
}

}  // namespace eigentrail
