// Files of the Matrix Market (.mtx, text; Boisvert, Pozo and Remington, The Matrix Market exchange formats:
// initial design, NISTIR 5935, 1996).
#pragma once

#include <string>
#include <string_view>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The matrix of a file with at most limits::matrix_rows rows and columns: coordinate (entries that are given
/// twice are added) or array; real, integer, pattern (ones), or complex with imaginary parts of zero;
/// general, symmetric, skew-symmetric, or Hermitian, which is symmetric if it is real. Throws InputError that
/// names file and line.
Matrix parse_market_file(std::string_view text, const std::string& path);

/// The same from a file.
Matrix read_market_file(const std::string& path);

}  // namespace eigentrail
