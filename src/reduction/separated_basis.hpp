// A basis of the tangent space that keeps apart what the constraints keep apart.
#pragma once

#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {

/// Orthonormal basis of the null space of the constraints, n x (n - rank), in which every column belongs to
/// coordinates that constraints connect: with bodies that no joint connects, motions of one body each. The
/// null basis of a factorization mixes them. Cost O(n^3).
Matrix separated_basis(const ConstraintFactorization& constraints);

}  // namespace eigentrail
