// Numbers as text.
#pragma once

#include <string>

namespace eigentrail {

/// Shortest text that reads back as the same double; "nan" and "inf" as such.
std::string exact_text(double value);

}  // namespace eigentrail
