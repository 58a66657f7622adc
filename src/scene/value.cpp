#include "eigentrail/scene/value.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "eigentrail/scene/limits.hpp"
#include "scene/toml_hints.hpp"

namespace eigentrail {
namespace {

SourceLocation location(const toml::node& node) {
  return {static_cast<int>(node.source().begin.line), static_cast<int>(node.source().begin.column)};
}

std::string prefix(const std::string& path, SourceLocation where) {
  return path + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

Table convert_table(const toml::table& source, const std::string& path, int depth);

[[noreturn]] void refuse_length(const std::string& path, SourceLocation where, const std::string& what,
                                std::size_t most) {
  throw InputError(prefix(path, where) + what + " of more than " + std::to_string(most) + " characters");
}

Value convert(const toml::node& node, const std::string& path, int depth) {
  const SourceLocation where = location(node);
  if (depth > limits::toml_nesting) {
    throw InputError(prefix(path, where) + "lists and tables nested deeper than " +
                     std::to_string(limits::toml_nesting) + " levels");
  }
  if (const auto* table = node.as_table()) return {convert_table(*table, path, depth), where};
  if (const auto* array = node.as_array()) {
    Array items;
    for (const toml::node& item : *array) items.push_back(convert(item, path, depth + 1));
    return {std::move(items), where};
  }
  if (const auto* text = node.as_string()) {
    if (text->get().size() > limits::text_length) refuse_length(path, where, "a text", limits::text_length);
    return {text->get(), where};
  }
  if (const auto* flag = node.as_boolean()) return {flag->get(), where};
  if (const auto* number = node.as_floating_point()) return {number->get(), where};
  if (const auto* number = node.as_integer()) return {static_cast<double>(number->get()), where};
  throw InputError(prefix(path, where) + "dates and times have no meaning in a scene");
}

Table convert_table(const toml::table& source, const std::string& path, int depth) {
  Table table;
  table.where = location(source);
  for (const auto& [key, node] : source) {
    if (key.str().size() > limits::key_length)
      refuse_length(path, location(node), "a key", limits::key_length);
    Value value = convert(node, path, depth + 1);
    // Errors are reported at the position of the key, not at that of its value.
    value.where = {static_cast<int>(key.source().begin.line), static_cast<int>(key.source().begin.column)};
    table.entries.emplace_back(std::string(key.str()), std::move(value));
  }
  const auto in_file_order = [](const auto& a, const auto& b) {
    return std::pair(a.second.where.line, a.second.where.column) <
           std::pair(b.second.where.line, b.second.where.column);
  };
  std::stable_sort(table.entries.begin(), table.entries.end(), in_file_order);
  return table;
}

/// Index of the last character of the string literal that begins at `i`: its closing quote, or the end of the
/// line or text if it is not closed.
std::size_t end_of_text(std::string_view text, std::size_t i) {
  const char quote = text[i];
  const std::string triple(3, quote);
  const bool over_lines = text.substr(i, 3) == triple;
  for (i += over_lines ? 3 : 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (over_lines ? text.substr(i, 3) == triple : text[i] == quote) {
      return i + (over_lines ? 2 : 0);
    } else if (!over_lines && text[i] == '\n') {
      return i - 1;
    }
  }
  return text.size() - 1;
}

/// Keys with very many parts would create tables nested so deeply that destroying them exhausts the stack.
/// Counts dots outside of string literals since the last character that ends a key or a number. Two dots in a
/// row reset the count: they occur in neither.
void reject_deep_keys(std::string_view text, const std::string& path) {
  constexpr int most_parts = limits::key_parts;
  int line = 1;
  int parts = 0;
  char last = ' ';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::size_t end = end_of_text(text, i);
      line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                          text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end;
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
      parts = 0;
    } else if (c == '.') {
      parts = last == '.' ? 0 : parts + 1;
    } else if (std::string_view(",=\n{}[]").find(c) != std::string_view::npos) {
      parts = 0;
      line += c == '\n';
    }
    if (parts > most_parts) {
      throw InputError(prefix(path, {line, 1}) + "a key of more than " + std::to_string(most_parts) +
                       " parts");
    }
    last = c;
  }
}

}  // namespace

Table::Table() = default;
Table::Table(const Table&) = default;
Table::Table(Table&&) noexcept = default;
Table& Table::operator=(const Table&) = default;
Table& Table::operator=(Table&&) noexcept = default;
Table::~Table() = default;

const Value* Table::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

std::string Value::kind() const {
  static const std::array<std::string, 5> names = {"true or false", "a number", "a text", "an array",
                                                   "a table"};
  return names[data.index()];
}

Table parse_toml(std::string_view text, const std::string& path) {
  reject_deep_keys(text, path);
  try {
    return convert_table(toml::parse(text, path), path, 0);
  } catch (const toml::parse_error& error) {
    const SourceLocation where{static_cast<int>(error.source().begin.line),
                               static_cast<int>(error.source().begin.column)};
    throw InputError(prefix(path, where) + "not valid TOML: " + std::string(error.description()) +
                     toml_hint(text, where.line, error.description()));
  }
}

}  // namespace eigentrail
