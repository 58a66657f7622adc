// Shared by the corrector of all pairs and by their certificate.
#pragma once

#include "eigentrail/modes/all_pairs.hpp"

namespace eigentrail {

/// M Z Lambda^2 + C Z Lambda + K Z for all pairs of a pencil (matrices n x n).
ComplexMatrix residual(const Matrix& M, const Matrix& C, const Matrix& K, const PairSet& pairs);
ComplexMatrix residual(const PencilAtPoint& pencil, const PairSet& pairs);

/// B Z for a real matrix B and many complex columns. A diagonal B, such as the E of x' = A x, only scales
/// rows.
ComplexMatrix multiply_many(const Matrix& B, const ComplexMatrix& Z);

/// Inverse of X -> X L - D X for small square D and L, acting on vec X.
ComplexMatrix inverse_sylvester(const ComplexMatrix& D, const ComplexMatrix& L);

}  // namespace eigentrail
