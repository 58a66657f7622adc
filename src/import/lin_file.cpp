#include "import/lin_file.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

/// Digits of single precision, with which OpenFAST may have been compiled.
constexpr int digits_of_single_precision = 7;

class LinReader {
 public:
  LinReader(std::string_view text, const std::string& path) : lines_(text, path) { file_.path = path; }

  LinFile read() {
    bool single = false;
    while (const auto line = lines_.next()) {
      single = single || line->find("single precision") != std::string_view::npos;
      read_line(trimmed(*line));
    }
    if (file_.states.empty())
      lines_.fail(
          "no table 'Order of continuous states'; is this a linearization file of OpenFAST (.lin) of a "
          "model with states?");
    if (file_.A.size() == 0)
      lines_.fail(
          "no matrix 'A: n x n'; the file ends before it, or LinOutJac is set "
          "for other matrices only");
    if (file_.A.rows() != static_cast<Eigen::Index>(file_.states.size()))
      lines_.fail("A has " + std::to_string(file_.A.rows()) + " rows; the table lists " +
                  std::to_string(file_.states.size()) + " states");
    if (single) file_.digits = std::min(file_.digits, digits_of_single_precision);
    return std::move(file_);
  }

 private:
  void read_line(std::string_view line) {
    if (line.starts_with("Rotor Speed:"))
      file_.rotor_speed = quantity(line, "rad/s", "rpm", std::numbers::pi / 30.0);
    if (line.starts_with("Azimuth:")) file_.azimuth = quantity(line, "rad", "deg", std::numbers::pi / 180.0);
    if (line.starts_with("Wind Speed:")) file_.wind_speed = quantity(line, "m/s", "km/h", 1.0 / 3.6);
    if (line.starts_with("Order of continuous states:")) read_table(file_.states);
    if (line.starts_with("Order of inputs") || line.starts_with("Order of outputs"))
      read_table(file_.operating_values);
    if (line.starts_with("A:") && file_.A.size() == 0) read_matrix(line);
  }

  /// "Rotor Speed:  0.7301 rad/s" in the first of two units.
  double quantity(std::string_view line, std::string_view unit, std::string_view other, double factor) {
    const auto words = words_of(line.substr(line.find(':') + 1));
    const auto value = words.empty() ? std::nullopt : number_of(words[0]);
    if (!value || !std::isfinite(*value)) lines_.fail("expected a number and its unit");
    if (words.size() < 2 || words[1] == unit) return *value;
    if (words[1] == other) return *value * factor;
    lines_.fail("expected a number in " + std::string(unit) + ", found " + std::string(words[1]));
  }

  /// Rows "1  2.8E-002  F  2  ED 1st tower ..., m" until a line of another kind.
  void read_table(std::vector<LinQuantity>& table) {
    while (const auto line = lines_.next()) {
      const auto words = words_of(*line);
      if (words.empty()) return;
      if (!whole_number_of(words[0])) continue;  // titles
      table.push_back(row(*line, words));
      if (table.size() > limits::matrix_rows)
        lines_.fail("more than " + std::to_string(limits::matrix_rows) + " rows");
    }
  }

  LinQuantity row(std::string_view line, const std::vector<std::string_view>& words) {
    const auto flag = std::ranges::find_if(words, [](std::string_view w) { return w == "T" || w == "F"; });
    std::string_view first = words.size() > 1 ? words[1] : std::string_view();
    if (!first.empty() && first.back() == ',') first.remove_suffix(1);
    const auto value = number_of(first);
    if (flag == words.end() || flag - words.begin() < 2 || !value || flag + 1 == words.end())
      lines_.fail(
          "expected a row number, an operating value, T or F, the derivative order and a description");
    LinQuantity result;
    result.value = *value;
    result.rotating = *flag == "T";
    auto description = flag + 1;
    if (const auto order = whole_number_of(*description); order && description + 1 != words.end()) {
      if (*order < 0 || *order > 2)
        lines_.fail("derivative order " + std::to_string(*order) + "; expected 0, 1 or 2");
      result.derivative_order = static_cast<int>(*order);
      ++description;
    }
    result.description =
        std::string(trimmed(line.substr(static_cast<std::size_t>(description->data() - line.data()))));
    if (result.description.size() > limits::text_length) lines_.fail("a description that is too long");
    return result;
  }

  /// "A: 30 x 30" and the rows that follow.
  void read_matrix(std::string_view title) {
    const auto words = words_of(title.substr(2));
    const auto rows = words.size() == 3 ? whole_number_of(words[0]) : std::nullopt;
    const auto columns = words.size() == 3 ? whole_number_of(words[2]) : std::nullopt;
    if (!rows || !columns || *rows != *columns || *rows < 1 || *rows > limits::matrix_rows)
      lines_.fail("expected 'A: n x n' with n up to " + std::to_string(limits::matrix_rows));
    std::vector<double> entries;  // row by row
    file_.digits = 1;
    for (long r = 0; r < *rows; ++r) {
      const std::vector<double> row = matrix_row(static_cast<std::size_t>(*columns), r);
      entries.insert(entries.end(), row.begin(), row.end());
    }
    file_.A = Matrix::Map(entries.data(), *columns, *rows).transpose();
  }

  std::vector<double> matrix_row(std::size_t count, long r) {
    const auto line = lines_.next();
    if (!line) lines_.fail("the file ends before row " + std::to_string(r + 1) + " of A; it was cut short");
    const auto words = words_of(*line);
    if (words.size() != count)
      lines_.fail("row " + std::to_string(r + 1) + " of A has " + std::to_string(words.size()) +
                  " numbers; expected " + std::to_string(count));
    const std::string expected = "row " + std::to_string(r + 1) + " of A: expected a number";
    std::vector<double> result;
    for (const std::string_view word : words) {
      result.push_back(lines_.number(word, expected));
      file_.digits = std::max(file_.digits, printed_digits(word));
    }
    return result;
  }

  TextLines lines_;
  LinFile file_;
};

}  // namespace

LinFile parse_lin_file(std::string_view text, const std::string& path) {
  return LinReader(text, path).read();
}

}  // namespace eigentrail
