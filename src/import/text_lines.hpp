// Lines and words of text files of other programs, with errors that name the line.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/texts.hpp"

namespace eigentrail {

/// The content of a file of at most `limits::text_file_bytes`. Throws InputError.
std::string read_text_file(const std::string& path);

/// Goes through a text line by line.
class TextLines {
 public:
  TextLines(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

  /// The next line without its end, or nothing.
  std::optional<std::string_view> next();
  int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

  /// A word as a finite number. `expected` begins the message where it is none: "expected a number".
  double number(std::string_view word, std::string_view expected) const;
  /// A word as a whole number from `least` to `most`.
  long whole(std::string_view word, std::string_view expected, long least = std::numeric_limits<long>::min(),
             long most = std::numeric_limits<long>::max()) const;

 private:
  std::string_view rest_;
  std::string path_;
  int line_ = 0;
};

/// The columns [begin, begin + width) of a line, as far as it has them.
std::string_view columns_of_line(std::string_view line, std::size_t begin, std::size_t width);
/// The begin of a word in quotes, for messages.
std::string shown(std::string_view word);
/// Words between separators; a text in one of the quotes is one word, with its quotes.
std::vector<std::string_view> words_of(std::string_view line, std::string_view separators = " \t\r\f\v",
                                       std::string_view quotes = "");

/// A decimal number with exponent E, D or, as Fortran prints long exponents, with a sign only (1.5-101).
/// Empty if the word is anything else.
std::optional<double> number_of(std::string_view word);
/// A whole number; empty if the word is anything else.
std::optional<long> whole_number_of(std::string_view word);
/// Whether a parameter may have this name: a letter, then letters, digits and underscores.
bool is_identifier(std::string_view name);
/// Significant digits of a number as printed; leading zeros do not count. 0 for zero and whole numbers.
int printed_digits(std::string_view word);

/// Goes through the lines of an input file of OpenFAST, a value, its name and a description on each, without
/// comments and empty lines.
class InputLines : private TextLines {
 public:
  using TextLines::fail;
  using TextLines::number;
  using TextLines::TextLines;

  /// The words of the next line, or nothing at the end. Commas separate words, too, and texts in quotes are
  /// one word.
  std::vector<std::string_view> next();

  /// A word as a whole number from 1 to `most`. `what` says in messages what it is.
  std::size_t count(std::string_view word, const std::string& what, std::size_t most) const;
  /// The first `count` words as finite numbers. What follows must not be a number.
  std::vector<double> row(const std::vector<std::string_view>& words, std::size_t count,
                          const std::string& what) const;
};

/// Whether the second word of a line is this name, in upper or lower case.
bool has_name(const std::vector<std::string_view>& words, std::string_view name);

/// A word without the quotes around it.
std::string without_quotes(std::string_view word);

}  // namespace eigentrail
