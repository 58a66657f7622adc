// Units of parameters: "rad/s", "mm", "N m^-1", "kg m^2", "rpm".
#pragma once

#include <optional>
#include <string_view>

namespace eigentrail {

/// Factor that turns a value in `unit` into SI (radians for angles): unit_factor("rpm") = 2 pi / 60.
/// Units multiply by a space, '*' or '·', divide by '/', and take whole powers ("m^2"); "" and "1" and "-"
/// are 1. Empty when the text is not understood.
std::optional<double> unit_factor(std::string_view unit);

}  // namespace eigentrail
