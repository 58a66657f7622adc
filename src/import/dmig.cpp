#include "import/dmig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

constexpr std::size_t small_width = 8;
constexpr std::size_t large_width = 16;
/// Columns of a line that hold fields; the last eight are for marks of continuation.
constexpr std::size_t line_width = 72;
/// Largest number of a point in Nastran.
constexpr long most_points = 100'000'000;

class DmigReader {
 public:
  DmigReader(std::string_view text, const std::string& path) : lines_(text, path) {}

  std::vector<DmigMatrix> read() {
    while (const auto line = lines_.next()) {
      const std::string_view content = line->substr(0, line->find('$'));
      if (trimmed(content).empty()) continue;
      const bool continues = std::string_view(" +*,\t").find(content.front()) != std::string_view::npos;
      if (continues) {
        if (column_) read_entries(fields_of(content), 0);
      } else {
        read_first_line(content);
      }
    }
    return std::move(matrices_);
  }

 private:
  /// The fields of a line behind its first one: 8, or 4 large ones.
  std::vector<std::string_view> fields_of(std::string_view line) const {
    std::vector<std::string_view> fields;
    const std::size_t comma = line.find(',');
    const std::string_view first = line.substr(0, std::min(comma, small_width));
    const bool large = first.find('*') != std::string_view::npos;
    const std::size_t count = large ? 4 : 8;
    if (comma != std::string_view::npos) {
      line.remove_prefix(comma + 1);
      while (fields.size() < count) {
        const std::size_t end = line.find(',');
        fields.push_back(trimmed(line.substr(0, end)));
        line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
      }
      return fields;
    }
    if (line.find('\t') != std::string_view::npos) lines_.fail("tabs between fields; replace them by blanks");
    const std::size_t width = large ? large_width : small_width;
    for (std::size_t at = small_width; at < line_width; at += width)
      fields.push_back(columns_of_line(line, at, width));
    return fields;
  }

  void read_first_line(std::string_view line) {
    column_ = false;
    std::string_view entry = trimmed(line.substr(0, std::min(line.find_first_of(",\t"), small_width)));
    if (!entry.empty() && entry.back() == '*') entry.remove_suffix(1);
    if (!equal_words(trimmed(entry), "DMIG")) return;
    const std::vector<std::string_view> fields = fields_of(line);
    const std::string name = upper_case(std::string(fields[0]));
    if (name.empty()) lines_.fail("DMIG without the name of a matrix");
    const auto found = std::ranges::find_if(matrices_, [&](const DmigMatrix& m) { return m.name == name; });
    if (fields[1] == "0") {
      if (found != matrices_.end()) lines_.fail("matrix " + printable(name) + " has two headers");
      read_header(name, fields);
      return;
    }
    if (found == matrices_.end())
      lines_.fail("matrix " + printable(name) +
                  " has no header (DMIG, name, 0, form, type) before its columns");
    matrix_ = static_cast<std::size_t>(found - matrices_.begin());
    at_ = freedom(fields[1], fields[2]);
    column_ = true;
    read_entries(fields, 4);
  }

  void read_header(const std::string& name, const std::vector<std::string_view>& fields) {
    constexpr std::size_t most_matrices = 1000;
    if (matrices_.size() == most_matrices)
      lines_.fail("more than " + std::to_string(most_matrices) + " matrices");
    const auto form = whole_number_of(fields[2]), type = whole_number_of(fields[3]);
    if (!form || !type || *type < 1 || *type > 4)
      lines_.fail("matrix " + printable(name) + ": expected a form and a type from 1 to 4 behind the 0");
    DmigMatrix matrix{{name, {}, *type == 1, 0, {}}, *form == 6};
    if (*type > 2)
      matrix.fault = "is complex (type " + std::to_string(*type) + "); expected real numbers";
    else if (*form != 1 && *form != 6)
      matrix.fault = "has form " + std::to_string(*form) + "; expected 1 (square) or 6 (symmetric)";
    matrices_.push_back(std::move(matrix));
  }

  DmigFreedom freedom(std::string_view point, std::string_view component) const {
    const long number = lines_.whole(point, "expected the number of a point", 1, most_points);
    const long direction =
        component.empty() ? 0 : lines_.whole(component, "expected a component from 0 to 6", 0, 6);
    return {static_cast<std::int32_t>(number), static_cast<std::int32_t>(direction)};
  }

  /// Point, component, real and imaginary part of each entry, from field `begin` on.
  void read_entries(const std::vector<std::string_view>& fields, std::size_t begin) {
    DmigMatrix& matrix = matrices_[matrix_];
    const std::string expected = "matrix " + printable(matrix.name) + ": expected a finite number";
    for (std::size_t i = begin; i + 3 < fields.size(); i += 4) {
      if (fields[i].empty() && fields[i + 1].empty() && fields[i + 2].empty()) continue;
      const DmigFreedom row = freedom(fields[i], fields[i + 1]);
      const double value = lines_.number(fields[i + 2], expected);
      if (!matrix.fault.empty()) continue;
      if (++entries_ > limits::matrix_numbers)
        lines_.fail("more than " + std::to_string(limits::matrix_numbers) + " entries");
      matrix.digits = std::max(matrix.digits, printed_digits(fields[i + 2]));
      matrix.entries.push_back({row, at_, value});
    }
  }

  TextLines lines_;
  std::vector<DmigMatrix> matrices_;
  bool column_ = false;     ///< the lines belong to a column of a matrix
  std::size_t matrix_ = 0;  ///< its place
  DmigFreedom at_;          ///< the column
  std::size_t entries_ = 0;
};

}  // namespace

std::string name_of(const DmigFreedom& freedom) {
  static const std::array<const char*, 7> directions{"", "T1", "T2", "T3", "R1", "R2", "R3"};
  const std::string point = std::to_string(freedom.point);
  return freedom.component == 0
             ? "point " + point
             : "grid " + point + ", " + directions[static_cast<std::size_t>(freedom.component)];
}

Matrix dense_matrix(const DmigMatrix& matrix, const std::vector<DmigFreedom>& freedoms) {
  const auto n = static_cast<Eigen::Index>(freedoms.size());
  const auto place = [&freedoms](const DmigFreedom& freedom) {
    return std::ranges::lower_bound(freedoms, freedom) - freedoms.begin();
  };
  // NaN stands for entries that are not given.
  Matrix result = Matrix::Constant(n, n, NAN);
  const auto set = [&](Eigen::Index r, Eigen::Index c, const DmigEntry& entry) {
    if (!std::isnan(result(r, c)) && result(r, c) != entry.value)
      throw std::invalid_argument("matrix " + printable(matrix.name) + " has two entries for row " +
                                  name_of(entry.row) + " and column " + name_of(entry.column));
    result(r, c) = entry.value;
  };
  for (const DmigEntry& entry : matrix.entries) {
    const Eigen::Index r = place(entry.row), c = place(entry.column);
    set(r, c, entry);
    if (matrix.symmetric && r != c) set(c, r, entry);
  }
  return result.array().isNaN().select(0.0, result);
}

std::vector<DmigMatrix> parse_dmig(std::string_view text, const std::string& path) {
  return DmigReader(text, path).read();
}

}  // namespace eigentrail
