#include "hard_cases/wide_pencil.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace eigentrail::test {
namespace {

constexpr Wide rounding = std::numeric_limits<Wide>::epsilon();

/// One rotation that makes S(i, j) zero.
void rotate(WideMatrix& S, Eigen::Index i, Eigen::Index j) {
  const Wide theta = (S(j, j) - S(i, i)) / (2 * S(i, j));
  const Wide t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::hypot(theta, Wide(1)));
  const Wide c = 1 / std::hypot(t, Wide(1));
  const Wide s = t * c;
  const Wide moved = t * S(i, j);
  for (Eigen::Index k = 0; k < S.rows(); ++k) {
    if (k == i || k == j) continue;
    const Wide left = S(k, i);
    const Wide right = S(k, j);
    S(k, i) = S(i, k) = c * left - s * right;
    S(k, j) = S(j, k) = s * left + c * right;
  }
  S(i, i) -= moved;
  S(j, j) += moved;
  S(i, j) = S(j, i) = 0;
}

/// Eigenvalues mu of mu^2 A + mu B + D = 0, A regular, after the scaling mu = gamma nu that balances A and D.
std::vector<WideComplex> companion_eigenvalues(const WideMatrix& A, const WideMatrix& B,
                                               const WideMatrix& D) {
  const Eigen::Index n = A.rows();
  const Wide ratio = std::sqrt(D.norm() / A.norm());
  const Wide gamma = ratio > 0 ? ratio : 1;
  const Eigen::FullPivLU<WideMatrix> lu(A);
  WideMatrix companion = WideMatrix::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -lu.solve(D) / (gamma * gamma);
  companion.bottomRightCorner(n, n) = -lu.solve(B) / gamma;
  const Eigen::EigenSolver<WideMatrix> solver(companion, false);
  std::vector<WideComplex> result;
  for (Eigen::Index i = 0; i < 2 * n; ++i) result.push_back(gamma * solver.eigenvalues()[i]);
  return result;
}

bool is_plain_symmetric(const WideMatrix& M, const WideMatrix& C, const WideMatrix& K) {
  return M.isIdentity(0) && C.isZero(0) && K == K.transpose();
}

}  // namespace

std::vector<Wide> jacobi_eigenvalues(WideMatrix S) {
  const Eigen::Index n = S.rows();
  constexpr int max_sweeps = 60;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    bool done = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = i + 1; j < n; ++j) {
        if (std::abs(S(i, j)) <= rounding * std::sqrt(std::abs(S(i, i) * S(j, j)))) continue;
        rotate(S, i, j);
        done = false;
      }
    }
    if (done) break;
  }
  std::vector<Wide> values(S.diagonal().begin(), S.diagonal().end());
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<Complex> eigenvalues(const WidePencil& pencil) {
  const WideMatrix M = pencil.M.real();
  const WideMatrix C = pencil.C.real();
  const WideMatrix K = pencil.K.real();
  if (is_plain_symmetric(M, C, K)) {
    const std::vector<Wide> mu = jacobi_eigenvalues(K);
    return undamped_pairs({mu.begin(), mu.end()});
  }
  const auto smallest_pivot = [](const WideMatrix& X) {
    const Eigen::FullPivLU<WideMatrix> lu(X);
    return lu.matrixLU().diagonal().cwiseAbs().minCoeff() / lu.maxPivot();
  };
  const bool reversed = smallest_pivot(M) < Wide(0.01) * smallest_pivot(K);
  const auto raw = reversed ? companion_eigenvalues(K, C, M) : companion_eigenvalues(M, C, K);
  std::vector<Complex> result;
  Wide largest = 0;
  for (const WideComplex mu : raw) largest = std::max(largest, std::abs(mu));
  for (const WideComplex mu : raw) {
    // In the reversed pencil an infinite eigenvalue is a zero, up to rounding.
    if (reversed && std::abs(mu) <= 100 * rounding * largest) continue;
    result.push_back(narrow(reversed ? WideComplex(1) / mu : mu));
  }
  return result;
}

std::vector<Complex> undamped_pairs(const std::vector<WideComplex>& mu) {
  std::vector<Complex> result;
  for (const WideComplex value : mu) {
    const WideComplex root = std::sqrt(value);
    const Complex s = narrow({-root.imag(), root.real()});
    result.push_back(s);
    result.push_back(-s);
  }
  return result;
}

std::vector<Complex> quadratic_roots(WideComplex a, WideComplex b, WideComplex c) {
  WideComplex root = std::sqrt(b * b - Wide(4) * a * c);
  if ((std::conj(b) * root).real() < 0) root = -root;
  const WideComplex q = -(b + root) / Wide(2);
  if (q == WideComplex(0)) return {narrow(0), narrow(0)};
  if (a == WideComplex(0)) return {narrow(c / q)};
  return {narrow(q / a), narrow(c / q)};
}

}  // namespace eigentrail::test
