// What the corrections of all pairs and their certificate share.
#pragma once

#include "eigentrail/modes/all_pairs.hpp"

namespace eigentrail {

/// M Z Lambda^2 + C Z Lambda + K Z of all pairs of a pencil (n x n each).
ComplexMatrix residual(const Matrix& M, const Matrix& C, const Matrix& K, const PairSet& pairs);

}  // namespace eigentrail
