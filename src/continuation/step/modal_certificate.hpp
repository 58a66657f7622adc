// The certificate of a step for all tracks at once, in modal coordinates.
//
// The test of certificate.hpp for the companion form A(t) x = s x. In the basis V of all interpolated pairs
// at the middle of a piece, A(t) = V (D + E(t)) V^-1 with the block diagonal matrix D of all Lambda, and the
// inverse of the Jacobian is a division by differences of eigenvalues; where a block takes part, the solution
// of a small Sylvester equation. So one modal basis and a few matrix products give Y, Z1 and Z2 of every
// track; one by one, each eigenvalue needs an LU and tens of solutions. Z1 is bounded by the Frobenius norm.
#pragma once

#include "eigentrail/continuation/certificate.hpp"

namespace eigentrail {

/// Norm of the inverse of X -> A X - X B (A is m x m, B k x k) in the Frobenius norm of X, the reciprocal of
/// their separation (Golub & Van Loan, Matrix Computations, Sect. 7.2.4): 1 / |a - b| for two numbers. It
/// tells how far apart two blocks are, also of sensitive eigenvalues. 1e100 where A and B share one. Cost
/// O((m k)^3).
double inverse_distance(const ComplexMatrix& A, const ComplexMatrix& B);

/// For every track between the points of the pencil, whether its test closes. False for the tracks of other
/// parts than `part`, that of the pencil, and for all if those of the part are not a basis of its state
/// space; they have to be tested one by one.
std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, int part, RunCounts& counts);

}  // namespace eigentrail
