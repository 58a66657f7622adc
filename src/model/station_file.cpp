#include "model/station_file.hpp"

#include <algorithm>
#include <filesystem>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "model/beside_scene.hpp"
#include "model/csv_table.hpp"

namespace eigentrail {
namespace {

/// The key that a column stands for.
const FieldHelp& field_of(const TableReader& table, const std::string& column,
                          const std::vector<FieldHelp>& fields) {
  std::vector<std::string> keys;
  for (const FieldHelp& field : fields) keys.push_back(field.key);
  const auto found = std::find(keys.begin(), keys.end(), column);
  if (found == keys.end() || column == "file" || column == "stiffness")
    table.fail("file", "column '" + printable(column) + "': no such key; " + suggestion(column, keys));
  return fields[static_cast<std::size_t>(found - keys.begin())];
}

}  // namespace

std::map<std::string, std::vector<double>> read_station_file(const Scene& scene, TableReader& table,
                                                             const std::vector<FieldHelp>& fields) {
  const std::string path = beside_scene(scene, table);
  if (!std::filesystem::exists(path)) table.fail("file", "cannot open " + path);
  const CsvTable stations = read_csv(scene, table, "file");
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

}  // namespace eigentrail
