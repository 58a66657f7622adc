// Schur form with selected eigenvalues first.
#pragma once

#include <vector>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct OrderedSchur {
  ComplexMatrix T, U;  ///< Lambda = U T U^H, T upper triangular
};

/// Schur form in which the eigenvalues of `Lambda` nearest to `leading` come first on the diagonal, in the
/// order of `leading` (Golub & Van Loan 2013, Sect. 7.6.2).
OrderedSchur ordered_schur(const ComplexMatrix& Lambda, const std::vector<Complex>& leading);

}  // namespace eigentrail
