// Stability by energy, without eigenvalues.
#pragma once

#include "eigentrail/model/model.hpp"
#include "eigentrail/reduction/reduced_pencil.hpp"

namespace eigentrail {

/// Whether the energy shows that no mode of a pencil grows at its point (Kelvin, Tait & Chetaev): M and K are
/// symmetric, M is positive semidefinite, K positive definite, and C + C^T positive semidefinite. Signs that
/// may be rounding show nothing. `structure`: of the model. Cost: up to three Cholesky factors of size n.
bool is_stable_by_energy(const ReducedPencil& pencil, const Structure& structure);

}  // namespace eigentrail
