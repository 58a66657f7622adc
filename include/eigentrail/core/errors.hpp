// Errors that end a run, and help for messages about unknown names. Numerical failures (no convergence, step
// too small) are return values, not exceptions.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace eigentrail {

/// Position of a text in an input file. Lines and columns count from 1; 0 means unknown.
struct SourceLocation {
  int line = 0;
  int column = 0;

  friend bool operator==(const SourceLocation&, const SourceLocation&) = default;
};

/// The place of a value that replaces one of the scene, or is not there: an option of the caller.
inline constexpr SourceLocation given_as_option{-1, 0};

/// Bad input: a scene, file or command line that cannot be used. The message needs no additions:
/// "file:line:column: key: what was expected, what was found, what to do".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate closest to `name` by edit distance. Empty if every distance exceeds min(3, half the length
/// of `name`, rounded up), with at least one edit allowed, or if `name` has more than 200 characters.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// Whether `name` is `known` with a usual typing error: other capitals, one letter left out or added, two
/// neighbours swapped. Names shorter than four characters, and names that differ in digits, as those of
/// siblings do (k1, k2), are no misprints.
bool is_misprint(std::string_view name, std::string_view known);

/// "did you mean 'x'?" if a candidate is close, else "known: " with the first 100 candidates.
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace eigentrail
