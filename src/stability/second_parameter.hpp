// Requirements on the second parameter of maps and boundaries.
#pragma once

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Throws InputError, with a message about --second, unless `second` is a declared parameter, is not defined
/// by an expression, is not trimmed, and differs from `first`.
void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first);

}  // namespace eigentrail
