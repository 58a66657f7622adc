// Independent spectra and comparisons for tests.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail::test {

/// All eigenvalues of s E y = A y by LAPACK's QZ without any scaling; infinite ones are left out.
/// `n_infinite` receives their number: |beta| <= `infinite` |alpha|.
std::vector<Complex> qz_eigenvalues(const Matrix& A, const Matrix& E, double infinite = 1e-14,
                                    int* n_infinite = nullptr);

/// [[0, I], [-K, -C]] - s [[I, 0], [0, M]], as it is written in textbooks; eigenvectors are [z; s z].
struct CompanionPencil {
  Matrix A, E;  ///< 2n x 2n
};
CompanionPencil companion_pencil(const Matrix& M, const Matrix& C, const Matrix& K);

/// All 2n eigenvalues of (s^2 M + s C + K) z = 0 from the unscaled companion form.
std::vector<Complex> quadratic_eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K);

/// All eigenvalues of a matrix by LAPACK's QR; those of a real one are exactly conjugate.
ComplexVector qr_eigenvalues(Matrix A);
ComplexVector qr_eigenvalues(ComplexMatrix A);

/// Distance from s to the nearest member of `spectrum`, relative to |s|.
double relative_distance(Complex s, const std::vector<Complex>& spectrum);

/// Largest relative distance when two lists are matched one to one by repeatedly taking the closest pair;
/// infinite when the sizes differ.
double matched_distance(std::vector<Complex> a, std::vector<Complex> b);

}  // namespace eigentrail::test
