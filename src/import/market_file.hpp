// Files of the Matrix Market (.mtx, text; Boisvert, Pozo and Remington, The Matrix Market exchange formats:
// initial design, NISTIR 5935, 1996).
#pragma once

#include <string>
#include <string_view>

#include "eigentrail/core/system_matrix.hpp"

namespace eigentrail {

/// The matrix of a file: coordinate (sparse; entries that are given twice are added), of at most
/// limits::sparse_rows rows and columns, or array (dense), of at most limits::matrix_rows; real, integer,
/// pattern (ones), or complex with imaginary parts of zero; general, symmetric, skew-symmetric, or Hermitian,
/// which is symmetric if it is real. Throws InputError that names file and line.
SystemMatrix parse_market_file(std::string_view text, const std::string& path);

}  // namespace eigentrail
