// The parameter that a scene traces, and those that it trims.
#pragma once

#include <string>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The name that [trace] of the scene gives as `parameter`, whether it is declared or not; empty if it gives
/// none.
std::string traced_parameter(const Scene& scene);

/// Names of the unknowns of [[trim]] tables, whether they are declared or not.
std::vector<std::string> trimmed_parameters(const Scene& scene);

/// Whether a [[trim]] of the scene determines the parameter.
bool is_trimmed(const Scene& scene, const std::string& parameter);

}  // namespace eigentrail
