// Tangent basis of a large model whose linearized equations are restricted to few motions.
#pragma once

#include <optional>

#include "eigentrail/model/projection.hpp"
#include "eigentrail/reduction/tangent_basis.hpp"

namespace eigentrail {

/// Where the linearized equations are restricted to few motions: T(0) spans the motions v with A v = 0
/// that differ from one of `motions` by B^T y, B the constraints at the reference, that is, v = (I - B^T (A
/// B^T)^-1 A) u. A motion v that is allowed here is there if and only if its part that was allowed at the
/// reference is one of `motions`. T(0) depends smoothly on the place alone. Empty if the constraints have
/// turned by about 90 degrees since the reference. Cost: a sparse LU of size m and O(n k^2).
std::optional<TangentBasis> restricted_basis(const Motions& motions, const SystemMatrix& A,
                                             const ConstraintFactorization& constraints);

}  // namespace eigentrail
