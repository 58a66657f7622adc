// A few eigenvalues near a shift by Arnoldi iteration, as ARPACK-based programs compute them point by point.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail::test {

/// The Ritz values of `steps` Arnoldi steps (fully orthogonalized, no restart) with the companion pencil of
/// (s^2 M + s C + K) z = 0 inverted about `shift`, nearest to the shift first. One complex LU of size n, one
/// solve per step. Vectors are left out: a lower bound of what a user's program does.
ComplexVector eigenvalues_near(const Matrix& M, const Matrix& C, const Matrix& K, Complex shift, int steps);

}  // namespace eigentrail::test
