// What maps and boundaries ask of their second parameter.
#pragma once

#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

/// Throws InputError about --second unless `second` is a declared parameter that no expression defines, and
/// not `first`.
void check_second_parameter(const Parameters& parameters, const std::string& second,
                            const std::string& first);

}  // namespace eigentrail
