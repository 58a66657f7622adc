// Ordinal numbers in names of modes.
#pragma once

#include <string>

namespace eigentrail {

/// "1st", "2nd", "3rd", "4th", ...
inline std::string ordinal(int n) {
  const int last = n % 10, tens = n / 10 % 10;
  const char* ending = tens == 1 ? "th" : last == 1 ? "st" : last == 2 ? "nd" : last == 3 ? "rd" : "th";
  return std::to_string(n) + ending;
}

}  // namespace eigentrail
