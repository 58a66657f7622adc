// Units of parameters: "rad/s", "mm", "N m^-1", "kg m^2", "rpm".
//
// A table of its own, not a library of units (udunits2, Boost.Units, pint): to all of them a hertz is 1/s, so
// that a rotor speed in Hz comes out 2 pi too small without a word, and their messages know no scene. What a
// scene needs of them is a table of some fifty units.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "eigentrail/scene/dimension.hpp"

namespace eigentrail {

struct Unit {
  double factor = 1.0;  ///< SI value = factor * value; angles in radians
  Dimension dimension = {};
  /// Whether the factor contains pi: rev, rpm, Hz, deg. Expressions see the value in radians.
  bool angle = false;
};

/// The unit that a text denotes. A space, '*' or '·' multiplies, '/' divides by the next unit, and units may
/// have integer powers ("m^2"). "", "1" and "-" are the unit of a number. Hz is one revolution per second,
/// 2 pi rad/s. Returns an empty value if the unit is not understood.
std::optional<Unit> parse_unit(std::string_view unit);

/// Its factor: unit_factor("rpm") = 2 pi / 60.
std::optional<double> unit_factor(std::string_view unit);

/// What to write instead of a unit that is not understood: "did you mean 'rpm'?", or examples.
std::string unit_suggestion(std::string_view unit);

/// "3 Hz", "200 rpm", "5 rad/s" or "5" as an angular frequency in rad/s. An empty value if the text is no
/// number, or the unit none of a frequency.
std::optional<double> angular_frequency(std::string_view text);

}  // namespace eigentrail
