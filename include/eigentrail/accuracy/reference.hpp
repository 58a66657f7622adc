// Reference eigenvalues with 113 bits at one parameter value: what errors are measured against.
//
// Iterative refinement (Wilkinson 1963; Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed.,
// Ch. 12) at every stage: residuals come from the scene's physics evaluated in binary128, corrections from
// the factors in double precision, again and again until they no longer shrink.
//
//     A^T lambda - f(x) = 0, c(x) = 0         corrected by the KKT factors
//     A T = 0                                 T - A+ (A T)
//     M Z Lambda^2 + C Z Lambda + K Z = 0     corrected by the factors of the invariant pair
//
// Nothing is taken from a trace but where to look for the equilibrium. The numbers of the scene count as the
// doubles nearest to them.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/extended.hpp"

namespace eigentrail {

enum class ReferenceStatus {
  converged,
  no_equilibrium,  ///< in double precision, or its refinement did not converge
  no_spectrum,     ///< QZ failed, or the pencil is singular
  not_converged,   ///< the refinement of a mode did not converge
  not_available    ///< the model has no extended precision
};

struct [[nodiscard]] ReferenceSpectrum {
  ReferenceStatus status = ReferenceStatus::not_available;
  std::vector<ExtendedComplex> s;  ///< finite eigenvalues, one per complex pair, Im s >= 0
  double correction = 0.0;         ///< largest last correction of all stages, relative: its accuracy
};

/// Corrections that stop shrinking above this are no convergence.
inline constexpr double reference_accuracy = 1e-20;

/// All finite eigenvalues at the parameter value p, the equilibrium looked for at `guess`. Cost: a spectrum
/// by QZ, one LU per mode, and some O(n^3) of software arithmetic, about 50 times as slow as double
/// precision.
ReferenceSpectrum reference_spectrum(const PathProblem& problem, double p, const EquilibriumGuess& guess);

}  // namespace eigentrail
