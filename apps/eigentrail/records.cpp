#include "records.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

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

std::string csv_text(const Records& records) {
  std::string text;
  for (const std::string& column : records.columns) text += (text.empty() ? "" : ",") + csv_cell(column);
  text += "\n";
  for (const std::vector<Cell>& row : records.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + field(row[i], records.unknown);
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json json_of(const Records& records) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::vector<Cell>& row : records.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i) {
      auto& value = object[records.columns[i]];  // null: not known, or infinite
      if (const auto* number = std::get_if<double>(&row[i])) {
        if (std::isfinite(*number)) value = *number;
      } else if (const auto* whole = std::get_if<std::int64_t>(&row[i])) {
        value = *whole;
      } else {
        value = std::get<std::string>(row[i]);
      }
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
  std::fputs(csv_text(records).c_str(), stdout);
}

}  // namespace eigentrail::app
