// Reference eigenvalues at one parameter value, with a significand of 113 bits. Errors are measured against
// them.
//
// Each stage is an iterative refinement (Wilkinson 1963; Higham, Accuracy and Stability of Numerical
// Algorithms, 2nd ed., Ch. 12). The residuals are evaluated in binary128 arithmetic from the model. The
// corrections are solved with the factors in double precision. This is repeated until the corrections no
// longer decrease.
//
//     A^T lambda - f(x) = 0, c(x) = 0         corrected by the KKT factors
//     A T = 0                                 T - A+ (A T)
//     M Z Lambda^2 + C Z Lambda + K Z = 0     corrected by the factors of the invariant pair
//
// The result depends on a trace only by the starting value for the equilibrium. The numbers of the scene are
// the doubles nearest to their decimal texts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eigentrail/continuation/path_point.hpp"
#include "eigentrail/core/extended.hpp"

namespace eigentrail {

enum class ReferenceStatus {
  converged,
  no_equilibrium,  ///< none found in double precision, or its refinement did not converge
  no_spectrum,     ///< QZ failed, or the pencil is singular
  not_converged,   ///< the refinement of a mode did not converge
  not_available    ///< the model cannot be evaluated in extended precision
};

struct [[nodiscard]] ReferenceSpectrum {
  ReferenceStatus status = ReferenceStatus::not_available;
  std::vector<ExtendedComplex> s;  ///< finite eigenvalues, one per complex pair, Im s >= 0
  double correction = 0.0;  ///< largest last correction of all stages, relative: an estimate of the error

  std::vector<Complex> nearest_doubles() const;
};

/// The refinement has converged if its last relative correction is at most this.
inline constexpr double reference_accuracy = 1e-20;

/// All finite eigenvalues at the parameter value p. With `followed` (1/s; NaN is left out) those beside them
/// are refined, and the others as QZ finds them. `guess`: starting value for the equilibrium. Cost: a
/// spectrum by QZ, one LU per refined mode, and O(n^3) operations of binary128 arithmetic in software, which
/// is about 50 times slower than double precision.
ReferenceSpectrum reference_spectrum(const PathProblem& problem, double p, const EquilibriumGuess& guess,
                                     const std::optional<ComplexVector>& followed = {});

}  // namespace eigentrail
