// How far apart two blocks of eigenvalues are, where the eigenvalues of a block may be sensitive.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// The upper triangular factor of the Schur form of a square matrix.
ComplexMatrix triangular_form(const ComplexMatrix& Lambda);

/// Norm of the inverse of X -> A X - X B for upper triangular A (m x m) and B (k x k), the reciprocal of
/// their separation (Golub & Van Loan, Matrix Computations, Sect. 7.2.4): 1 / |a - b| for two numbers. In the
/// Frobenius norm of X; estimated by power iteration with a factor of safety unless m = k = 1. 1e100 where A
/// and B share an eigenvalue. Cost O((m + k) m k).
double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B);

}  // namespace eigentrail
