// Matrices as a scene has them.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/core/text.hpp"
#include "eigentrail/core/types.hpp"

namespace eigentrail::test {

/// Coefficients of a polynomial as a TOML array of matrices, with all digits.
inline std::string text(const std::vector<Matrix>& coefficients) {
  std::string all;
  for (const Matrix& A : coefficients) {
    std::string rows;
    for (const auto& row : A.rowwise()) {
      std::string entries;
      for (const double x : row) entries += (entries.empty() ? "" : ", ") + exact_text(x);
      rows += (rows.empty() ? "[" : ", [") + entries + "]";
    }
    all += (all.empty() ? "[" : ", [") + rows + "]";
  }
  return "[" + all + "]";
}

}  // namespace eigentrail::test
