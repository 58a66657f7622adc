#include "support/spectra.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>

namespace eigentrail::test {

std::vector<Complex> qz_eigenvalues(const Matrix& A, const Matrix& E, double infinite, int* n_infinite) {
  Matrix a = A;
  Matrix b = E;
  const auto n = static_cast<lapack_int>(a.rows());
  Vector alpha_real(n), alpha_imag(n), beta(n);
  const lapack_int info =
      LAPACKE_dggev(LAPACK_COL_MAJOR, 'N', 'N', n, a.data(), n, b.data(), n, alpha_real.data(),
                    alpha_imag.data(), beta.data(), nullptr, 1, nullptr, 1);
  if (info != 0) throw std::runtime_error("dggev did not converge");
  std::vector<Complex> finite;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Complex alpha(alpha_real[i], alpha_imag[i]);
    if (std::abs(beta[i]) > infinite * std::abs(alpha)) finite.push_back(alpha / beta[i]);
  }
  if (n_infinite != nullptr) *n_infinite = static_cast<int>(n) - static_cast<int>(finite.size());
  return finite;
}

CompanionPencil companion_pencil(const Matrix& M, const Matrix& C, const Matrix& K) {
  const Eigen::Index n = M.rows();
  CompanionPencil pencil{Matrix::Zero(2 * n, 2 * n), Matrix::Identity(2 * n, 2 * n)};
  pencil.A.topRightCorner(n, n).setIdentity();
  pencil.A.bottomLeftCorner(n, n) = -K;
  pencil.A.bottomRightCorner(n, n) = -C;
  pencil.E.bottomRightCorner(n, n) = M;
  return pencil;
}

std::vector<Complex> quadratic_eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K) {
  const CompanionPencil pencil = companion_pencil(M, C, K);
  return qz_eigenvalues(pencil.A, pencil.E);
}

ComplexVector qr_eigenvalues(Matrix A) {
  const auto n = static_cast<lapack_int>(A.rows());
  Vector real(n), imag(n);
  if (LAPACKE_dgeev(LAPACK_COL_MAJOR, 'N', 'N', n, A.data(), n, real.data(), imag.data(), nullptr, 1, nullptr,
                    1) != 0)
    throw std::runtime_error("dgeev did not converge");
  ComplexVector s(n);
  s.real() = real;
  s.imag() = imag;
  return s;
}

ComplexVector qr_eigenvalues(ComplexMatrix A) {
  const auto n = static_cast<lapack_int>(A.rows());
  ComplexVector s(n);
  if (LAPACKE_zgeev(LAPACK_COL_MAJOR, 'N', 'N', n, A.data(), n, s.data(), nullptr, 1, nullptr, 1) != 0)
    throw std::runtime_error("zgeev did not converge");
  return s;
}

double relative_distance(Complex s, const std::vector<Complex>& spectrum) {
  double nearest = INFINITY;
  for (const Complex other : spectrum) nearest = std::min(nearest, std::abs(s - other));
  return nearest / std::abs(s);
}

double matched_distance(std::vector<Complex> a, std::vector<Complex> b) {
  if (a.size() != b.size()) return INFINITY;
  double worst = 0.0;
  while (!a.empty()) {
    std::size_t best_i = 0;
    std::size_t best_j = 0;
    double best = INFINITY;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        const double distance = std::abs(a[i] - b[j]) / std::max(std::abs(a[i]), 1e-300);
        if (distance < best) {
          best = distance;
          best_i = i;
          best_j = j;
        }
      }
    }
    worst = std::max(worst, best);
    a.erase(a.begin() + static_cast<std::ptrdiff_t>(best_i));
    b.erase(b.begin() + static_cast<std::ptrdiff_t>(best_j));
  }
  return worst;
}

}  // namespace eigentrail::test
