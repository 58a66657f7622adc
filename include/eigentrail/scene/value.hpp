// A TOML document as plain data, with the position of every value in the file.
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {

struct Value;

/// Keys and values in the order in which they appear in the file.
struct Table {
  std::vector<std::pair<std::string, Value>> entries;
  SourceLocation where;

  // Defined in value.cpp, where Value is complete.
  Table();
  Table(const Table&);
  Table(Table&&) noexcept;
  Table& operator=(const Table&);
  Table& operator=(Table&&) noexcept;
  ~Table();

  const Value* find(std::string_view key) const;
};

using Array = std::vector<Value>;

struct Value {
  std::variant<bool, double, std::string, Array, Table> data;
  SourceLocation where;

  /// "a number", "a text", ... for messages.
  std::string kind() const;
};

/// What a table has under a key, if it is of this kind; else null.
template <class Kind>
const Kind* entry_as(const Table& table, std::string_view key) {
  const Value* value = table.find(key);
  return value == nullptr ? nullptr : std::get_if<Kind>(&value->data);
}

/// Parses TOML. Integers become numbers; dates and times are refused. `path` names the file in messages.
/// Throws InputError with line and column if the text is not valid TOML or exceeds a limit.
Table parse_toml(std::string_view text, const std::string& path);

}  // namespace eigentrail
