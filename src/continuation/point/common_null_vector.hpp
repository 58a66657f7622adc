// Common null vectors of M, C and K: freedoms without mass, damping and stiffness. They make the pencil
// singular.
#pragma once

#include <string>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// If M, C and K of the point's pencil have a common null vector, the name of the coordinate that moves most
/// in it; else empty.
std::string null_vector_coordinate(const Model& model, const PathPoint& point);

}  // namespace eigentrail
