// A spectrum by QZ, refined.
#pragma once

#include <vector>

#include "eigentrail/modes/spectrum.hpp"
#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

/// Magnitude below which an eigenvalue counts as zero, as a share of the scale of the pencil.
inline constexpr double share_that_is_zero = 1e-9;

/// Refines the first `n` eigenvalues of a spectrum by Newton's method, close ones together: QZ is accurate
/// relative to the largest ones only. Returns their errors by rounding, 1/s, infinite for those that stay as
/// they are. Cost: a factorization for each.
std::vector<double> refine(const ReducedPencil& pencil, int n, Spectrum& spectrum);

}  // namespace eigentrail
