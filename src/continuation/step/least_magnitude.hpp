// Where on a step the eigenvalues of a block are smallest: errors are relative to their size, and beside a
// zero of s (or of 1/s, an infinite eigenvalue) that is much less than at the ends of the step.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The t in [0, 1] at which the product of the eigenvalues is smallest, to 1e-5 of the step: where one of
/// them vanishes, if one does. `functions` are the block's functions (modes/invariants.hpp) as polynomials in
/// t, one row each. Finds a dip that at least one of 9 equidistant samples tells.
double place_of_least_magnitude(const ComplexMatrix& functions);

}  // namespace eigentrail
