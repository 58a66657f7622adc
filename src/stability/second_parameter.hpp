// Requirements on the second parameter of maps and boundaries.
#pragma once

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Throws InputError, with a message about --second, unless `second` is a declared parameter, is not defined
/// by an expression, is not trimmed, and differs from `first`.
void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first);

/// Throws InputError unless the options, `overrides`, or the scene give the range of the first parameter. The
/// scene's is that of the parameter which it names.
void require_first_range(const Scene& scene, const OptionTexts& overrides);

}  // namespace eigentrail
