// Shared by the corrector of all pairs, by their certificate and by the series of pairs.
#pragma once

#include "eigentrail/modes/all_pairs.hpp"

namespace eigentrail {

/// Z with the columns of every pair multiplied by its block of `Lambda`.
ComplexMatrix with_blocks(const PairSet& pairs, ComplexMatrix Z, const ComplexMatrix& Lambda);

/// M Z Lambda^2 + C Z Lambda + K Z for all pairs of a pencil (matrices n x n).
ComplexMatrix residual(const Matrix& M, const Matrix& C, const Matrix& K, const PairSet& pairs);
ComplexMatrix residual(const PencilAtPoint& pencil, const PairSet& pairs);

/// Removes the imaginary parts of changes of real pairs.
void make_real(const PairSet& pairs, ComplexMatrix& Z, ComplexMatrix& Lambda);

}  // namespace eigentrail
