// Lines of OpenFAST's input files: a value, its name, a description.
#pragma once

#include "import/text_lines.hpp"

namespace eigentrail {

/// Goes through the lines of such a file, without comments and empty lines.
class InputLines {
 public:
  InputLines(std::string_view text, const std::string& path) : lines_(text, path) {}

  /// The words of the next line, or nothing at the end. Words in quotes are one word, with their quotes.
  std::vector<std::string_view> next();
  [[noreturn]] void fail(const std::string& message) const { lines_.fail(message); }

  /// A word of the current line as a finite number. `what` says in messages what it is.
  double number(std::string_view word, const std::string& what) const;
  /// A word as a whole number from 1 to `most`.
  std::size_t count(std::string_view word, const std::string& what, std::size_t most) const;
  /// The first `count` words as finite numbers. What follows must not be a number.
  std::vector<double> row(const std::vector<std::string_view>& words, std::size_t count,
                          const std::string& what) const;

 private:
  TextLines lines_;
};

/// Whether the second word of a line is this name, in upper or lower case.
bool has_name(const std::vector<std::string_view>& words, std::string_view name);

/// A word without the quotes around it.
std::string without_quotes(std::string_view word);

}  // namespace eigentrail
