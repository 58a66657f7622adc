// Numbers as people read them.
#pragma once

#include <sstream>
#include <string>

namespace eigentrail {

/// A number with so many significant digits.
inline std::string short_text(double number, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

}  // namespace eigentrail
