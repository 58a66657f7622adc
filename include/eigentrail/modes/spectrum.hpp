// The whole spectrum of a pencil at one point, by LAPACK's QZ on the scaled companion linearization.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

struct StartingMode {
  Complex s;        ///< Im s >= 0; a complex pair is represented by this member
  ComplexVector z;  ///< unit length; empty where eigenvalues alone were asked for
};

enum class SpectrumStatus { complete, singular_pencil, not_converged };

struct [[nodiscard]] Spectrum {
  SpectrumStatus status = SpectrumStatus::not_converged;
  std::vector<StartingMode> modes;  ///< finite ones, by ascending |s|
  int n_infinite = 0;               ///< infinite eigenvalues (singular mass)
  double scale = 1.0;               ///< gamma = sqrt(|K| / |M|), the typical magnitude of eigenvalues
};

/// Solves (s^2 M + s C + K) z = 0. The pencil is scaled by s = gamma mu and a common factor so that all three
/// matrices have norms near one (Fan, Lin & Van Dooren, SIAM J. Matrix Anal. Appl. 26, 2004). Cost about 60
/// (2n)^3.
Spectrum compute_spectrum(const Matrix& M, const Matrix& C, const Matrix& K);

/// The same without vectors, which are more than half of the work.
Spectrum compute_eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K);

/// Vector of the eigenvalue nearest to s, of unit length, by inverse iteration with P(sigma)^-1 P'(sigma),
/// sigma a little beside s: good enough for the corrector where the next eigenvalue is not nearer than 1e-6
/// |s|. Real where s is. `scale` is that of the spectrum. Cost one LU of size n.
ComplexVector eigenvector_near(const Matrix& M, const Matrix& C, const Matrix& K, Complex s, double scale);

/// The block of the k eigenvalues nearest to `centre`, by inverse iteration with k vectors on the companion
/// form: reliable also where single vectors coincide. `is_real` asks for a real block; the centre is then
/// real. Not yet corrected. Cost one LU of size 2n.
InvariantPair invariant_subspace(const Matrix& M, const Matrix& C, const Matrix& K, Complex centre,
                                 Eigen::Index k, bool is_real, double least_scale = 0.0);

}  // namespace eigentrail
