// The parameter that a scene traces.
#pragma once

#include <string>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The name that [trace] of the scene gives as `parameter`, whether it is declared or not; empty if it gives
/// none.
std::string traced_parameter(const Scene& scene);

}  // namespace eigentrail
