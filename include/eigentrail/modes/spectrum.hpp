// The whole spectrum of a pencil at one point, by LAPACK on the scaled companion linearization.
#pragma once

#include <vector>

#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {

struct StartingMode {
  Complex s;        ///< Im s >= 0; this member represents a complex pair
  ComplexVector z;  ///< unit length; empty if only eigenvalues were requested
  int part = 0;     ///< of the equations, where they fall apart
  int copy = 0;     ///< number of the equal part that it belongs to, from 1; 0: the part itself
  bool is_permanent_zero =
      false;  ///< zero for every value of the parameter, and left out of choices of modes
};

/// The order of the modes of a spectrum: by |s|, then by Im s and Re s.
bool comes_before(const StartingMode& a, const StartingMode& b);

enum class SpectrumStatus { complete, singular_pencil, not_converged };

struct [[nodiscard]] Spectrum {
  SpectrumStatus status = SpectrumStatus::not_converged;
  std::vector<StartingMode> modes;  ///< finite modes in the order of increasing |s|
  int n_infinite = 0;               ///< number of infinite eigenvalues (singular mass matrix)
  double scale = 1.0;               ///< gamma = sqrt(|K| / |M|), or |C| / |M| if K = 0: typical |s|
};

/// Solves (s^2 M + s C + K) z = 0 by the QZ algorithm. The pencil is scaled by s = gamma mu and by a common
/// factor so that the norms of all three matrices are close to one (Fan, Lin & Van Dooren, SIAM J. Matrix
/// Anal. Appl. 26, 2004). Cost about 60 (2n)^3 multiplications.
Spectrum compute_spectrum(const Matrix& M, const Matrix& C, const Matrix& K);

/// The same without eigenvectors, which take more than half of the work. If M is well-conditioned it is
/// inverted, and the QR algorithm replaces QZ.
Spectrum compute_eigenvalues(const Matrix& M, const Matrix& C, const Matrix& K);

/// The same of a reduced pencil at its point, part by part where it falls apart. Vectors are those of the
/// part. A mode of a part with copies is followed by those of the copies, which are equal.
Spectrum compute_spectrum(const ReducedPencil& pencil);
Spectrum compute_eigenvalues(const ReducedPencil& pencil);

/// Eigenvector of the eigenvalue nearest to s, of unit length, by inverse iteration with P(sigma)^-1
/// P'(sigma), sigma = s + 1e-9 max(|s|, s_ref). Accurate enough as start of the corrector if no other
/// eigenvalue is nearer than 1e-6 |s|. Real if s is real. `s_ref` is the reference magnitude of eigenvalues,
/// 1/s, > 0: it keeps sigma away from an eigenvalue zero. Cost: one LU of size n.
ComplexVector eigenvector_near(const Matrix& M, const Matrix& C, const Matrix& K, Complex s, double s_ref);
/// The same of a reduced pencil that does not fall apart, at its point: of a complex part, a vector of it.
ComplexVector eigenvector_near(const ReducedPencil& pencil, Complex s, double s_ref);

/// The block of the k eigenvalues nearest to `centre`, by inverse iteration with k vectors on the companion
/// form; reliable also if eigenvectors coincide. `is_real` requests a real block; `centre` must then be real.
/// `least_scale` is a lower bound of the scale gamma, for a stiffness that is only rounding. The block is not
/// corrected. Cost: one LU of size 2n.
InvariantPair invariant_subspace(const Matrix& M, const Matrix& C, const Matrix& K, Complex centre,
                                 Eigen::Index k, bool is_real, double least_scale = 0.0);
/// The same of a reduced pencil that does not fall apart, at its point. A block of a complex part is never
/// real.
InvariantPair invariant_subspace(const ReducedPencil& pencil, Complex centre, Eigen::Index k, bool is_real,
                                 double least_scale = 0.0);

}  // namespace eigentrail
