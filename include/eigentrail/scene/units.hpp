// Units of parameters: "rad/s", "mm", "N m^-1", "kg m^2", "rpm".
#pragma once

#include <optional>
#include <string_view>

namespace eigentrail {

/// Factor that converts a value in `unit` to SI (angles to radians): unit_factor("rpm") = 2 pi / 60. A space,
/// '*' or '·' multiplies, '/' divides by the next unit, and units may have integer powers ("m^2"). "", "1"
/// and "-" give 1. Returns an empty value if the unit is not understood.
std::optional<double> unit_factor(std::string_view unit);

/// "3 Hz", "200 rpm", "5 rad/s" or "5" as an angular frequency in rad/s. Hertz are turns per second here. An
/// empty value if the text is no number, or the unit none of a frequency.
std::optional<double> angular_frequency(std::string_view text);

}  // namespace eigentrail
