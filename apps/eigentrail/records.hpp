// Records with named columns, for CSV and JSON.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

namespace eigentrail::app {

/// A number, a count or a text. Numbers that are not known are NaN.
using Cell = std::variant<double, std::int64_t, std::string>;

/// A whole number of any type as a cell.
template <class Integer>
Cell count(Integer number) {
  return static_cast<std::int64_t>(number);
}

struct Records {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows = {};
};

/// A line of comma-separated values with its end; texts with commas or quotes are quoted (RFC 4180).
/// `unknown` stands for numbers that are not known.
std::string csv_line(const std::vector<Cell>& cells, const std::string& unknown);

/// Comma-separated values with a heading.
std::string csv_text(const Records& records, const std::string& unknown);

/// A list of objects; numbers that are not known or infinite are null.
nlohmann::ordered_json json_of(const Records& records);

/// Prints JSON on lines of their own.
void print_text_of(const nlohmann::ordered_json& json);

/// How a command prints records in place of a table for people.
struct PrintedFormat {
  bool csv = false;
  bool json = false;
  explicit operator bool() const { return csv || json; }
};
void print(const Records& records, const PrintedFormat& format);

}  // namespace eigentrail::app
