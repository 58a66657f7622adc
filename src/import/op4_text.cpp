// OUTPUT4 as text: numbers in columns of fixed width, without blanks between them.
#include <algorithm>
#include <cmath>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "import/op4.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

/// How a matrix prints its numbers, as Fortran says it: "1P,5E16.9" has 5 on a line, 16 columns each.
struct NumberFormat {
  std::size_t per_line = 5, width = 16;
  int digits = 10;
};

class Op4TextReader {
 public:
  Op4TextReader(std::string_view text, const std::string& path, const Op4Choice& wanted)
      : lines_(text, path), wanted_(wanted) {}

  std::vector<Op4Matrix> read() {
    while (const auto line = lines_.next()) {
      if (trimmed(*line).empty()) continue;
      if (matrices_.size() == most_op4_matrices)
        lines_.fail("more than " + std::to_string(most_op4_matrices) + " matrices");
      read_header(*line);
      while (read_column()) {
      }
    }
    if (matrices_.empty()) lines_.fail("no matrix of Nastran's OUTPUT4");
    return std::move(matrices_);
  }

 private:
  /// The whole number in some columns of a line.
  long whole(std::string_view line, std::size_t begin, std::size_t width) {
    return lines_.whole(columns_of_line(line, begin, width), "expected a whole number in columns " +
                                                                 std::to_string(begin + 1) + " to " +
                                                                 std::to_string(begin + width));
  }

  std::string_view next_line() {
    const auto line = lines_.next();
    if (!line) lines_.fail("the file ends within matrix " + printable(header_.name) + "; it was cut short");
    return *line;
  }

  /// Columns, rows, form and type in columns of 8, the name, and the format of the numbers. The first two are
  /// 16 wide if the format ends with |I16.
  void read_header(std::string_view line) {
    const bool wide = line.find("|I16") != std::string_view::npos;
    const std::size_t width = wide ? 16 : 8;
    header_ = {};
    header_.columns = whole(line, 0, width);
    header_.set_rows(whole(line, width, width));
    header_.form = whole(line, 2 * width, 8);
    header_.type = whole(line, 2 * width + 8, 8);
    const std::size_t name = 2 * width + 16;
    if (line.size() > name) header_.name = upper_case(std::string(trimmed(line.substr(name, 8))));
    format_ = {};
    if (line.size() > name + 8) read_format(trimmed(line.substr(name + 8, line.find('|') - name - 8)));
    matrices_.push_back(op4_matrix(header_, wanted_, [this](const std::string& why) { lines_.fail(why); }));
    matrices_.back().digits = format_.digits;
    last_column_ = 0;
  }

  /// "1P,5E16.9": a scale that plays no role when numbers are read, count, letter, width and digits behind
  /// the point.
  void read_format(std::string_view text) {
    if (text.empty()) return;
    const std::string shown = printable(std::string(text.substr(0, 40)));
    const std::size_t comma = text.find(',');
    if (comma != std::string_view::npos) text.remove_prefix(comma + 1);
    const std::size_t letter = text.find_first_of("EeDdFfGg"), point = text.find('.');
    const auto part = [&](std::size_t begin, std::size_t end) {
      return begin > end || end > text.size() ? std::nullopt
                                              : whole_number_of(trimmed(text.substr(begin, end - begin)));
    };
    const auto known = letter != std::string_view::npos && point != std::string_view::npos;
    const auto count = known ? part(0, letter) : std::nullopt;
    const auto width = known ? part(letter + 1, point) : std::nullopt;
    const auto digits = known ? part(point + 1, text.size()) : std::nullopt;
    if (!count || !width || !digits || *count < 1 || *width < 2 || *count > 1000 || *width > 100 ||
        *digits < 1 || *digits > *width)
      lines_.fail("expected a format of numbers such as 1P,5E16.9, found '" + shown + "'");
    format_ = {static_cast<std::size_t>(*count), static_cast<std::size_t>(*width),
               static_cast<int>(std::min(*digits + 1, 17L))};
  }

  /// Column, first row and number of words, then the numbers. Returns whether there are more: the last column
  /// is one beyond those of the matrix.
  bool read_column() {
    const std::string_view line = next_line();
    const long column = whole(line, 0, 8), row = whole(line, 8, 8), words = whole(line, 16, 8);
    if (column <= last_column_ || column > header_.columns + 1)
      lines_.fail("column " + std::to_string(column) + " of matrix " + printable(header_.name) +
                  " follows column " + std::to_string(last_column_) + " of " +
                  std::to_string(header_.columns));
    if (row < 0 || words < 0) lines_.fail("expected a column, a row and a number of words");
    last_column_ = column;
    if (column == header_.columns + 1) {
      read_numbers(words, -1);
      return false;
    }
    if (row > 0) {
      read_numbers(words, row);
    } else {
      read_strings(words);
    }
    return true;
  }

  /// Strings of numbers with their length in words and their first row in front. `words` counts these, too.
  void read_strings(long words) {
    while (words > 0) {
      const std::string_view line = next_line();
      const long first = whole(line, 0, header_.bigmat ? 8 : 16);
      const long length = header_.bigmat ? first : first / op4_packing;
      const long row = header_.bigmat ? whole(line, 8, 8) : first % op4_packing;
      const long per_number = header_.single() ? 1 : 2;
      if (length < 2 || row < 1 || (length - 1) % per_number != 0 || length > words)
        lines_.fail("expected the length and the first row of a string of numbers");
      read_numbers((length - 1) / per_number, row);
      words -= length + (header_.bigmat ? 1 : 0);
    }
    if (words < 0)
      lines_.fail("the strings of column " + std::to_string(last_column_) +
                  " have more words than announced");
  }

  /// Numbers from a row on, which is -1 for those that are no part of the matrix.
  void read_numbers(long count, long row) {
    const long per_entry = header_.complex() ? 2 : 1;
    if (row > 0 && (row > header_.rows || count > (header_.rows - row + 1) * per_entry))
      lines_.fail(std::to_string(count) + " numbers from row " + std::to_string(row) + " on; matrix " +
                  printable(header_.name) + " has " + std::to_string(header_.rows) + " rows");
    Matrix& values = matrices_.back().values;
    const auto per_line = static_cast<long>(format_.per_line);
    std::string_view line;
    for (long i = 0; i < count; ++i) {
      if (i % per_line == 0) line = next_line();
      const std::size_t begin = static_cast<std::size_t>(i % per_line) * format_.width;
      const std::string_view field = columns_of_line(line, begin, format_.width);
      const auto value = number_of(field);
      if (!value || !std::isfinite(*value))
        lines_.fail("expected a finite number in columns " + std::to_string(begin + 1) + " to " +
                    std::to_string(begin + format_.width) + ", found '" + printable(std::string(field)) +
                    "'");
      if (row > 0 && values.size() > 0) values(row - 1 + i, last_column_ - 1) = *value;
    }
  }

  TextLines lines_;
  const Op4Choice& wanted_;
  std::vector<Op4Matrix> matrices_;
  Op4Header header_;  ///< of the present matrix
  NumberFormat format_;
  long last_column_ = 0;
};

}  // namespace

std::vector<Op4Matrix> parse_op4_text(std::string_view text, const std::string& path,
                                      const Op4Choice& wanted) {
  return Op4TextReader(text, path, wanted).read();
}

}  // namespace eigentrail
