// The place on a step where the eigenvalues of a block are smallest. Errors are relative to their size, which
// may be much smaller within the step than at its ends: beside a zero of s, or of 1/s in the reciprocal chart
// (an infinite eigenvalue).
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The t in [0, 1] at which the product of the eigenvalues has its smallest magnitude, to 1e-5 of the step.
/// If one of them vanishes, this is the place. `functions` are the block's functions (modes/invariants.hpp)
/// as polynomials in t, one row each, constant terms first. A minimum is found if at least one of 9
/// equidistant samples lies in its basin.
double place_of_least_magnitude(const ComplexMatrix& functions);

}  // namespace eigentrail
