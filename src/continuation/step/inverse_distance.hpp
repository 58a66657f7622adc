// How far apart two blocks of eigenvalues are, where the eigenvalues of a block may be sensitive.
#pragma once

#include "eigentrail/core/types.hpp"

namespace eigentrail {

/// Norm of the inverse of X -> A X - X B (A is m x m, B k x k) in the Frobenius norm of X, the reciprocal of
/// their separation (Golub & Van Loan, Matrix Computations, Sect. 7.2.4): 1 / |a - b| for two numbers. 1e100
/// where A and B share an eigenvalue. Cost O((m k)^3).
double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B);

}  // namespace eigentrail
