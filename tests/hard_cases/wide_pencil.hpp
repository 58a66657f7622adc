// Pencils and their spectra in extended precision: the independent side of every comparison.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail::test {

/// 64-bit mantissa on x86, more on machines where long double is wider.
using Wide = long double;
using WideComplex = std::complex<Wide>;
using WideMatrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>;
using WideComplexMatrix = Eigen::Matrix<WideComplex, Eigen::Dynamic, Eigen::Dynamic>;

/// To double precision.
inline Complex narrow(WideComplex s) {
  return {static_cast<double>(s.real()), static_cast<double>(s.imag())};
}

/// P(s) = s^2 M + s C + K without constraints.
struct WidePencil {
  WideComplexMatrix M, C, K;

  WideComplexMatrix at(WideComplex s) const { return s * s * M + s * C + K; }
  WideComplexMatrix slope(WideComplex s) const { return WideComplex(2) * s * M + C; }
};

/// Eigenvalues of a symmetric matrix by cyclic Jacobi rotations, ascending. Positive definite graded matrices
/// keep the relative accuracy of their small eigenvalues (Demmel & Veselic, SIAM J. Matrix Anal. Appl. 13,
/// 1992).
std::vector<Wide> jacobi_eigenvalues(WideMatrix S);

/// All finite eigenvalues of a pencil whose matrices are real (imaginary parts are zero), conjugate pairs
/// exactly conjugate. Jacobi on K where M is the identity, C zero and K symmetric; else QR of a companion
/// matrix, of the reversed pencil K mu^2 + C mu + M where the mass is nearly singular. The error of an
/// eigenvalue is some 1e-19 times its condition number: next to a defective one, 1e-9.
std::vector<Complex> eigenvalues(const WidePencil& pencil);

/// {j sqrt(mu), -j sqrt(mu)} for every mu: the spectrum of an undamped system with s^2 = -mu.
std::vector<Complex> undamped_pairs(const std::vector<WideComplex>& mu);

/// Both roots of a s^2 + b s + c = 0, without cancellation; one root where a = 0.
std::vector<Complex> quadratic_roots(WideComplex a, WideComplex b, WideComplex c);

}  // namespace eigentrail::test
