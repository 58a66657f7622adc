#include "model/station_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/units.hpp"
#include "model/beside_scene.hpp"

namespace eigentrail {
namespace {

std::string trimmed(const std::string& text) {
  const char* blank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) result.push_back(trimmed(cell));
  return result;
}

std::string content(const Scene& scene, TableReader& table) {
  const auto in_memory = scene.files.find(table.text("file"));
  if (in_memory != scene.files.end()) return *in_memory->second;
  const std::string path = beside_scene(scene, table);
  std::ifstream file(path, std::ios::binary);
  if (!file) table.fail("file", "cannot open " + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Heading {
  std::string key;
  double factor = 1.0;
};

Heading heading(const TableReader& table, const std::string& cell, const std::vector<FieldHelp>& fields) {
  const std::size_t bracket = cell.find('[');
  const std::string key = trimmed(cell.substr(0, bracket));
  std::vector<std::string> keys;
  for (const FieldHelp& field : fields) keys.push_back(field.key);
  const auto found = std::find(keys.begin(), keys.end(), key);
  if (found == keys.end() || key == "file" || key == "stiffness")
    table.fail("file", "column '" + printable(key) + "': no such key; " + suggestion(key, keys));
  if (bracket == std::string::npos || key == "span") return {key};
  const std::string unit = trimmed(cell.substr(bracket + 1, cell.find(']') - bracket - 1));
  const std::string wanted = fields[static_cast<std::size_t>(found - keys.begin())].unit;
  const auto parsed = parse_unit(unit);
  if (!parsed || !(parsed->dimension == parse_unit(wanted)->dimension))
    table.fail("file",
               "column '" + key + "': expected a unit of " + wanted + ", found '" + printable(unit) + "'");
  return {key, parsed->factor};
}

}  // namespace

std::map<std::string, std::vector<double>> read_station_file(const Scene& scene, TableReader& table,
                                                             const std::vector<FieldHelp>& fields) {
  std::istringstream text(content(scene, table));
  std::vector<Heading> headings;
  std::map<std::string, std::vector<double>> columns;
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    const std::string at = "line " + std::to_string(++number) + ": ";
    if (trimmed(line).empty() || trimmed(line)[0] == '#') continue;
    const std::vector<std::string> row = cells(line);
    if (headings.empty()) {
      for (const std::string& cell : row) headings.push_back(heading(table, cell, fields));
      continue;
    }
    if (row.size() != headings.size())
      table.fail("file", at + "expected " + std::to_string(headings.size()) + " numbers, found " +
                             std::to_string(row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(row[i].data(), row[i].data() + row[i].size(), value);
      if (error != std::errc() || end != row[i].data() + row[i].size() || !std::isfinite(value))
        table.fail("file", at + "expected a number, found '" + printable(row[i]) + "'");
      columns[headings[i].key].push_back(headings[i].factor * value);
    }
    if (columns.begin()->second.size() > limits::list_length)
      table.fail("file", "expected at most " + std::to_string(limits::list_length) + " stations");
  }
  if (!columns.contains("span")) table.fail("file", "expected a column span, and at least two stations");
  return columns;
}

}  // namespace eigentrail
