// The certificate of a step for all modes at once, in modal coordinates.
//
// The tube of certificate.hpp on the companion form A(t) x = s x. In the basis V of all interpolated pairs at
// the middle of a piece A(t) = V (D + E(t)) V^-1, and the inverse of the Jacobian there is a division by the
// differences of eigenvalues: one modal basis and a few matrix products bound Y, Z1 and Z2 of every mode,
// where the tubes one by one take an LU and tens of solutions each. Z1 is bounded by the Frobenius norm.
#pragma once

#include "eigentrail/continuation/certificate.hpp"

namespace eigentrail {

/// For every track between the points of the pencil, whether its tube closes; false for those that want to
/// be looked at by themselves: blocks of more than one, and all where the tracks are no basis.
std::vector<bool> certify_all(const StepPencil& pencil, const PathNode& right, RunCounts& counts);

}  // namespace eigentrail
