// Text for numbers, and text that is safe to print.
#pragma once

#include <string>

namespace eigentrail {

/// Shortest text that reads back as the same double; "nan" or "inf" for non-finite values.
std::string exact_text(double value);

/// Replaces control characters, line breaks included, by spaces. For text from scenes that is quoted in
/// messages and titles on a terminal.
std::string printable(std::string text);

}  // namespace eigentrail
