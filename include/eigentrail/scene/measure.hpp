// Numbers with their units, as the command line and ranges have them: "100 Hz", "2.5 kN/m", "40".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "eigentrail/scene/parameters.hpp"

namespace eigentrail {

struct Measure {
  double number = 0.0;
  std::string unit;  ///< as written; empty: none
};

/// A text that is a number and what may be a unit; empty for other texts, such as expressions ("2*m").
std::optional<Measure> parse_measure(std::string_view text);

/// A value, or what is wrong with it.
struct UnitValue {
  double value = 0.0;
  std::string fault;  ///< empty: none
};

/// The value in the unit of a parameter. Without a unit of its own the number is in that unit already; a
/// parameter without a unit gets the SI value. It is a fault if the unit is not known or of another
/// dimension.
UnitValue value_in_unit_of(const Parameter& parameter, const Measure& measure);

}  // namespace eigentrail
