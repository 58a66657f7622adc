// Numbers as text for tables.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

namespace eigentrail::test {

/// Three significant digits.
inline std::string short_text(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

/// "17 %".
inline std::string percent(double part, double whole) {
  return short_text(std::round(100.0 * part / whole)) + " %";
}

/// "0.31 s", "4.2 ms", "17 us".
inline std::string time_text(double seconds) {
  if (seconds < 1e-3) return short_text(1e6 * seconds) + " us";
  if (seconds < 1.0) return short_text(1e3 * seconds) + " ms";
  return short_text(seconds) + " s";
}

}  // namespace eigentrail::test
