#include "eigentrail/core/chebyshev.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/lapack.hpp"

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

/// Eigenvalues u of A - u B, by the QZ algorithm: a small leading coefficient, which stands in B, does
/// not spoil them as it would after a division.
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
  // u T_0 = T_1, u T_k = (T_{k-1} + T_{k+1}) / 2; c_n T_n in the last row, replaced through the polynomial.
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
  const Eigen::Index top = significant(coefficients);
  if (top == 0) return {};
  ComplexMatrix companion = ComplexMatrix::Zero(top, top);
  companion.bottomLeftCorner(top - 1, top - 1).setIdentity();
  companion.col(top - 1) = -coefficients.head(top) / coefficients[top];
  const ComplexVector roots = Eigen::ComplexEigenSolver<ComplexMatrix>(companion, false).eigenvalues();
  return {roots.begin(), roots.end()};
}

bool has_no_root_within(const ComplexVector& coefficients, double radius) {
  double others = 0.0;
  double power = 1.0;
  for (Eigen::Index k = 1; k < coefficients.size(); ++k)
    others += std::abs(coefficients[k]) * (power *= radius);
  return std::abs(coefficients[0]) > others;
}

}  // namespace eigentrail
