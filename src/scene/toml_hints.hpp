// What to do about texts that are not valid TOML: the mistakes that are made by hand.
#pragma once

#include <string>
#include <string_view>

namespace eigentrail {

/// A hint for the line with the error, to follow its message: "; put expressions in quotes: k = \"2*m\"".
/// Empty if none comes to mind. `line` counts from 1; `description` is what the parser says.
std::string toml_hint(std::string_view text, int line, std::string_view description);

}  // namespace eigentrail
