// Diagonal similarity that makes rows and columns of a matrix about equally large (Osborne, Journal of the
// ACM 7, 1960).
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Scales d such that the rows and columns of D^-1 A D are about equally large beside the diagonal, from the
/// squares of the entries of A (n x n). Rows and columns without entries keep the scale one. Cost n^2 per
/// sweep.
Vector balancing_scales(Matrix squares, int sweeps);

}  // namespace eigentrail
