// Freedoms that nothing acts on: without mass, damping and stiffness.
#pragma once

#include <string>

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Names the coordinate that moves most in a freedom that M, C and K of the point's pencil all leave out;
/// empty when there is none.
std::string idle_coordinate(const Model& model, const PathPoint& point);

}  // namespace eigentrail
