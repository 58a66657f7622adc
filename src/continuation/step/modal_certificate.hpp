// The certificate of a step for all modes at once, in modal coordinates.
//
// The test of certificate.hpp for the companion form A(t) x = s x. In the basis V of all interpolated pairs
// at the middle of a piece, A(t) = V (D + E(t)) V^-1, and the inverse of the Jacobian is a division by
// differences of eigenvalues. So one modal basis and a few matrix products give Y, Z1 and Z2 of every mode;
// one by one, each mode needs an LU and tens of solutions. Z1 is bounded by the Frobenius norm.
#pragma once

#include "eigentrail/continuation/certificate.hpp"

namespace eigentrail {

/// For every track between the points of the pencil, whether its tube closes. False also for tracks that have
/// to be tested one by one: blocks of more than one, and all tracks if they are not a basis of the state
/// space in the finite chart.
std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, RunCounts& counts);

}  // namespace eigentrail
