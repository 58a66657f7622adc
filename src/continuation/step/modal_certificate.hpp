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

/// For every track between the points of the pencil, whether its test closes. False for the tracks of other
/// parts than `part`, that of the pencil, and for all if those of the part are not a basis of its state
/// space; they have to be tested one by one.
std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, int part, RunCounts& counts);

}  // namespace eigentrail
