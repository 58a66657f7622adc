// Errors that end a run. Numerical outcomes (no convergence, a step that became too small) are values
// instead.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// Place of a text in an input file; lines and columns count from 1, 0 means unknown.
struct SourceLocation {
  int line = 0;
  int column = 0;
};

/// Bad input: a scene, file or command line that cannot be used. The message is complete as it stands:
/// "file:line:column: key: what was expected, what was found, what to do".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance, or an empty string when none is close enough to suggest.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "did you mean 'x'?" or the list of candidates, for messages about unknown names.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace eigentrail
