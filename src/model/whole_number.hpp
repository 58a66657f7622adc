// Whole numbers in the tables of a scene.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// The number of a key, which the table has. Throws InputError unless it is whole and lies in the range.
inline int whole_number(TableReader& table, const std::string& key, int least, int most) {
  const Expression expression = table.expression(key);
  const double value = expression.is_constant() ? expression.evaluate(std::span<const double>()) : NAN;
  if (!(value >= least && value <= most) || value != std::floor(value))
    table.fail(key, "expected a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

}  // namespace eigentrail
