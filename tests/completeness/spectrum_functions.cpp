#include "completeness/spectrum_functions.hpp"

#include <Eigen/LU>
#include <numbers>

#include "completeness/reference_events.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test {
namespace {

Scaled determinant(const Matrix& K) {
  const Eigen::PartialPivLU<Matrix> lu(K);
  Scaled value{lu.permutationP().determinant() > 0 ? 1 : -1, 0.0};
  for (const double factor : lu.matrixLU().diagonal()) value.multiply(factor);
  return value;
}

/// Product of s_i + sign s_j over all pairs of one spectrum; for sign = -1 squared.
void multiply_pairs(const AtParameter& at, double sign, Scaled& value) {
  const int power = sign < 0.0 ? 2 : 1;
  const auto multiply = [&](double factor) {
    for (int k = 0; k < power; ++k) value.multiply(factor);
  };
  for (std::size_t i = 0; i < at.upper.size(); ++i) {
    const Complex s = at.upper[i];
    if (sign < 0.0) {
      value.multiply(-4.0 * s.imag() * s.imag());
    } else {
      value.multiply(2.0 * s.real());
    }
    for (std::size_t j = 0; j < i; ++j) {
      multiply(std::norm(s + sign * at.upper[j]));
      multiply(std::norm(s + sign * std::conj(at.upper[j])));
    }
    for (const double r : at.real) multiply(std::norm(s + sign * r));
  }
  for (std::size_t i = 0; i < at.real.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) multiply(at.real[i] + sign * at.real[j]);
  }
}

}  // namespace

AtParameter spectrum_at(const Family& family, double p) {
  const RealPencil pencil = real_pencil(family, p);
  AtParameter at;
  Matrix A = companion_pencil(pencil.M, pencil.C, pencil.K).A;
  // M is well conditioned: QR is as good as QZ and takes a third of the time.
  A.bottomRows(pencil.M.rows()) = pencil.M.partialPivLu().solve(A.bottomRows(pencil.M.rows())).eval();
  for (const Complex s : qr_eigenvalues(A)) {
    if (s.imag() == 0.0) at.real.push_back(s.real());
    if (s.imag() > 0.0) at.upper.push_back(s);
  }
  std::sort(at.real.begin(), at.real.end());
  at.values[det_K] = determinant(pencil.K);
  at.values[F] = at.values[D] = {1, 0.0};
  multiply_pairs(at, 1.0, at.values[F]);
  multiply_pairs(at, -1.0, at.values[D]);
  // A factor that is zero has no sign; the number of pairs has one.
  at.values[D].sign = at.upper.size() % 2 == 0 ? 1 : -1;
  return at;
}

std::vector<double> chebyshev_coefficients(const std::function<Scaled(double)>& function, int degree) {
  std::vector<Scaled> values;
  double largest = -std::numeric_limits<double>::infinity();
  for (int k = 0; k <= degree; ++k) {
    const double x = k == 0 ? 1.0 : k == degree ? -1.0 : std::cos(std::numbers::pi * k / degree);
    values.push_back(function(x));
    largest = std::max(largest, values.back().log);
  }
  std::vector<double> result;
  for (int j = 0; j <= degree; ++j) {
    double sum = 0.0;
    for (int k = 0; k <= degree; ++k) {
      const Scaled& v = values[static_cast<std::size_t>(k)];
      const double weight = k == 0 || k == degree ? 0.5 : 1.0;
      sum += weight * v.sign * std::exp(v.log - largest) * std::cos(std::numbers::pi * j * k / degree);
    }
    result.push_back(sum * (j == 0 || j == degree ? 1.0 : 2.0) / degree);
  }
  return result;
}

/// Roots of a Chebyshev series as eigenvalues of its colleague matrix.
std::vector<Complex> chebyshev_roots(std::vector<double> c) {
  double largest = 0.0;
  for (const double value : c) largest = std::max(largest, std::abs(value));
  while (c.size() > 1 && std::abs(c.back()) <= 1e-13 * largest) c.pop_back();
  const auto n = static_cast<Eigen::Index>(c.size()) - 1;
  if (n == 0) return {};
  if (n == 1) return {Complex(-c[0] / c[1])};
  Matrix colleague = Matrix::Zero(n, n);
  colleague(0, 1) = 1.0;
  for (Eigen::Index i = 1; i < n; ++i) {
    colleague(i, i - 1) = 0.5;
    if (i + 1 < n) colleague(i, i + 1) = 0.5;
  }
  for (Eigen::Index j = 0; j < n; ++j)
    colleague(n - 1, j) -= 0.5 * c[static_cast<std::size_t>(j)] / c[static_cast<std::size_t>(n)];
  const ComplexVector roots = qr_eigenvalues(colleague);
  return {roots.begin(), roots.end()};
}

}  // namespace eigentrail::test
