#include "records.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail::app {
namespace {

std::string field(const Cell& cell, const std::string& unknown) {
  if (const auto* number = std::get_if<double>(&cell))
    return std::isnan(*number) ? unknown : exact_text(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return std::to_string(*whole);
  return csv_cell(std::get<std::string>(cell));
}

}  // namespace

std::string csv_line(const std::vector<Cell>& cells, const std::string& unknown) {
  return joined(cells, ",", [&](const Cell& cell) { return field(cell, unknown); }) + "\n";
}

std::string csv_text(const Records& records, const std::string& unknown) {
  std::string text = csv_line({records.columns.begin(), records.columns.end()}, unknown);
  for (const std::vector<Cell>& row : records.rows) text += csv_line(row, unknown);
  return text;
}

nlohmann::ordered_json json_of(const Records& records) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& row : records.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i) {
      // Numbers that are not finite are null when they are written.
      auto& value = object[records.columns[i]];
      std::visit([&value](const auto& cell) { value = cell; }, row[i]);
    }
    rows.push_back(std::move(object));
  }
  return rows;
}

void print_text_of(const nlohmann::ordered_json& json) {
  std::printf("%s\n", json.dump(2).c_str());
}

void print(const Records& records, const PrintedFormat& format) {
  if (format.json) return print_text_of(json_of(records));
  std::fputs(csv_text(records, "nan").c_str(), stdout);
}

}  // namespace eigentrail::app
