// Numbers as text.
#pragma once

#include <string>

namespace eigentrail {

/// Shortest text that reads back as the same double; "nan" and "inf" as such.
std::string exact_text(double value);

/// The text on one line without control characters, for terminals: what a scene says is quoted in messages
/// and titles.
std::string printable(std::string text);

}  // namespace eigentrail
