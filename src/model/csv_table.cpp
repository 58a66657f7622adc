#include "model/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

[[noreturn]] void csv_fault(const std::string& path, int line, const std::string& message) {
  throw InputError(path + ":" + std::to_string(line) + ": " + printable(message));
}

std::string without_blanks(std::string_view text) {
  return std::string(trimmed(text, " \t\r\""));
}

/// The character that separates the cells of the headings.
char separator_of(const std::string& headings) {
  for (const char one : {';', '\t', ','}) {
    if (headings.find(one) != std::string::npos) return one;
  }
  return ',';
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells = split(line, separator);
  for (std::string& cell : cells) cell = without_blanks(cell);
  return cells;
}

CsvColumn heading_of(const std::string& path, int line, const std::string& cell) {
  const std::size_t open = cell.find_first_of("[(");
  CsvColumn column{without_blanks(cell.substr(0, open)), "", {}};
  if (open != std::string::npos) {
    const std::size_t close = cell.find_last_of("])");
    if (close == std::string::npos || close < open)
      csv_fault(path, line, "the unit of '" + cell + "' is never closed; write \"outer [mm]\"");
    column.unit = without_blanks(cell.substr(open + 1, close - open - 1));
  }
  if (column.name.empty())
    csv_fault(path, line, "expected headings such as \"speed [rpm], kxx [N/m]\", found '" + cell + "'");
  return column;
}

double number_in(const CsvTable& table, int line, const CsvColumn& column, const std::string& cell) {
  const auto value = parsed_number<double>(std::string_view(cell).substr(cell.starts_with('+') ? 1 : 0));
  if (!value || !std::isfinite(*value))
    csv_fault(table.path, line, column.name + ": expected a finite number, found '" + cell + "'");
  return *value;
}

}  // namespace

const CsvColumn* CsvTable::find(const std::string& name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const auto& one) { return one.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

CsvTable read_csv(const std::string& path) {
  std::istringstream file(read_text(path, limits::scene_bytes));
  CsvTable table{path, {}, {}};
  char separator = ',';
  std::size_t bytes = 0;
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    bytes += text.size();
    if (bytes > limits::scene_bytes || table.rows() > limits::tables_of_a_kind)
      csv_fault(path, line, "the table is too long");
    const std::string content = without_blanks(text);
    if (content.empty() || content[0] == '#') continue;
    if (table.columns.empty()) {
      separator = separator_of(text);
      for (const std::string& cell : cells_of(text, separator)) {
        CsvColumn column = heading_of(path, line, cell);
        if (table.find(column.name) != nullptr)
          csv_fault(path, line, "two columns are called '" + column.name + "'");
        table.columns.push_back(std::move(column));
      }
      continue;
    }
    const std::vector<std::string> cells = cells_of(text, separator);
    if (cells.size() != table.columns.size())
      csv_fault(path, line,
                "has " + std::to_string(cells.size()) + " cells under " +
                    std::to_string(table.columns.size()) + " headings");
    table.lines.push_back(line);
    for (std::size_t i = 0; i < cells.size(); ++i)
      table.columns[i].values.push_back(number_in(table, line, table.columns[i], cells[i]));
  }
  if (table.rows() == 0) throw InputError(path + ": has no rows; expected headings and lines of numbers");
  return table;
}

double si_factor(const CsvTable& table, const CsvColumn& column, WantedUnit wanted) {
  if (column.unit.empty()) return 1.0;
  const auto unit = parse_unit(column.unit);
  if (!unit)
    throw InputError(table.path + ": column " + column.name + ": unit '" + column.unit + "' is not known; " +
                     unit_suggestion(column.unit));
  if (wanted && !(unit->dimension == parse_unit(*wanted)->dimension))
    throw InputError(table.path + ": column " + column.name + " is in " + column.unit + ", but " +
                     (wanted->empty() ? "a number without unit" : std::string(*wanted)) + " is expected");
  return unit->factor;
}

std::vector<double> si_values(const CsvTable& table, const CsvColumn& column, const std::string& wanted) {
  const double factor = si_factor(table, column, wanted);
  std::vector<double> values = column.values;
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace eigentrail
