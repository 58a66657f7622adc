#include "model/station_columns.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/gaps.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/csv_table.hpp"

namespace eigentrail {
namespace {

/// The key that a column stands for.
const FieldHelp& field_of(const TableReader& table, const std::string& column,
                          const std::vector<FieldHelp>& fields) {
  const std::vector<std::string> keys = names_of(fields, &FieldHelp::key);
  const auto found = std::find(keys.begin(), keys.end(), column);
  if (found == keys.end() || column == "file" || column == "stiffness")
    table.fail("file", "column '" + printable(column) + "': no such key; " + suggestion(column, keys));
  return fields[static_cast<std::size_t>(found - keys.begin())];
}

/// Columns of the CSV file that the key `file` names, in SI units, by the keys in its first line. A unit may
/// follow a key in brackets. `fields` are the keys that are known, with their units.
std::map<std::string, std::vector<double>> read_station_file(const Scene& scene, TableReader& table,
                                                             const std::vector<FieldHelp>& fields) {
  const std::string path = beside_scene(scene, table);
  if (!std::filesystem::exists(path)) table.fail("file", "cannot open " + path);
  const CsvTable stations = read_csv(scene, table, "file", std::identity());
  if (stations.rows() > limits::list_length)
    table.fail("file", "expected at most " + std::to_string(limits::list_length) + " stations");
  std::map<std::string, std::vector<double>> columns;
  for (const CsvColumn& column : stations.columns) {
    const FieldHelp& field = field_of(table, column.name, fields);
    // Places along the span are relative: any unit will do.
    columns[field.key] = field.key == "span" ? column.values : si_values(stations, column, field.unit);
  }
  if (!columns.contains("span")) table.fail("file", "expected a column span, and at least two stations");
  return columns;
}

}  // namespace

std::vector<StationShare> station_shares(const std::vector<double>& span, double s) {
  if (span.size() == 1) return {{0, 1.0}};
  const std::size_t right = gap_of(span, s) + 1;
  const double weight = (s - span[right - 1]) / (span[right] - span[right - 1]);
  return {{right - 1, 1.0 - weight}, {right, weight}};
}

StationColumns::StationColumns(Draft& draft, TableReader& table, const std::vector<FieldHelp>& file_fields)
    : draft_(draft), table_(table) {
  if (table.has("file")) file_ = read_station_file(draft.scene, table, file_fields);
  read_span();
}

StationColumns::Column StationColumns::required(const std::string& key, std::string_view unit, Range range) {
  Column column = list(key, unit);
  if (column.size() == 1) column.assign(stations(), Expression(column[0]));
  if (column.size() != stations()) {
    table_.fail(key, stations() == 1
                         ? "a list needs the places of its stations; give span as well"
                         : "expected one number, or one for each of the " + std::to_string(stations()) +
                               " stations of span; found " + std::to_string(column.size()));
  }
  for (const Expression& e : column) draft_.check_range(table_, key, e, range);
  return column;
}

StationColumns::Column StationColumns::optional(const std::string& key, std::string_view unit, Range range,
                                                double otherwise) {
  return has(key) ? required(key, unit, range) : Column(stations(), Expression(otherwise));
}

StationColumns::Column StationColumns::list(const std::string& key, WantedUnit unit) {
  if (table_.has(key) || !file_.contains(key)) return table_.list(key, unit);
  const std::vector<double>& values = file_.at(key);
  return {values.begin(), values.end()};
}

void StationColumns::read_span() {
  if (!has("span")) return;
  span_.clear();
  for (const Expression& e : list("span", {})) {
    if (!e.is_constant()) table_.fail("span", "expected numbers, found an expression of parameters");
    span_.push_back(e.value());
    const std::size_t n = span_.size();
    if (!std::isfinite(span_.back()) || (n > 1 && !(span_[n - 1] > span_[n - 2])))
      table_.fail("span", "expected numbers that increase from station to station");
  }
  if (span_.size() < 2) table_.fail("span", "expected at least two stations");
  const double first = span_.front();
  const double length = span_.back() - first;
  for (double& s : span_) s = (s - first) / length;
}

}  // namespace eigentrail
