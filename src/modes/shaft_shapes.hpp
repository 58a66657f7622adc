// Displacements of the nodes of a shaft in a mode.
#pragma once

#include <array>
#include <vector>

#include "eigentrail/model/model.hpp"

namespace eigentrail {

/// Displacements x and y of each node; zero where it is held. `shape`: coordinates of the model, also of one
/// that is the projection of a rotor.
std::vector<std::array<Complex, 2>> displacements(const Model& model, const SpinningShaft& shaft,
                                                  const ComplexVector& shape);

}  // namespace eigentrail
