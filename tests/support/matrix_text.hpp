// Matrices and matrix families as a scene has them.
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

/// Coefficients by powers of the parameter p. C may be empty, and A: no constraints.
struct FamilyMatrices {
  std::vector<Matrix> M, C, K, A = {};
};

/// The scene of a matrix family, traced from one p to another. `matrices` are the lines "M = ...".
inline std::string family_scene(const std::string& matrices, double from, double to) {
  return "[trace]\nparameter = \"p\"\nfrom = " + exact_text(from) + "\nto = " + exact_text(to) +
         "\n[matrix_family]\n" + matrices;
}
inline std::string family_scene(const FamilyMatrices& family, double from, double to) {
  std::string matrices;
  for (const auto& [key, coefficients] :
       {std::pair("M", &family.M), {"C", &family.C}, {"K", &family.K}, {"A", &family.A}})
    if (!coefficients->empty()) matrices += std::string(key) + " = " + text(*coefficients) + "\n";
  return family_scene(matrices, from, to);
}

}  // namespace eigentrail::test
