// Text for numbers, and text that is safe to print.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace eigentrail {

/// Shortest text that reads back as the same double; "nan" or "inf" for non-finite values.
std::string exact_text(double value);

/// Replaces control characters, line breaks included, by spaces. For text from scenes that is quoted in
/// messages and titles on a terminal.
std::string printable(std::string text);

/// A text as a cell of a table (CSV): in quotes where commas, quotes or line breaks need them. What a
/// spreadsheet would take for a formula, = + - @ and more, begins with an apostrophe, which marks texts
/// there; numbers stay numbers.
std::string csv_cell(const std::string& text);

/// Places, from 0, of the first two equal texts of a list; empty if all differ.
std::optional<std::pair<std::size_t, std::size_t>> first_repetition(const std::vector<std::string>& texts);

}  // namespace eigentrail
