#include "eigentrail/scene/value.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "core/texts.hpp"
#include "eigentrail/scene/limits.hpp"
#include "eigentrail/scene/measure.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

/// Where something begins in the file: a node, a key or an error.
SourceLocation location(const auto& item) {
  return {static_cast<int>(item.source().begin.line), static_cast<int>(item.source().begin.column)};
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
    value.where = location(key);
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

std::string_view line_of(std::string_view text, int line) {
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

/// The line without its comment; a '#' within quotes begins none. `open`: whether a quote is never closed.
std::string_view without_comment(std::string_view line, bool& open) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0) {
      quote = line[i] == quote ? 0 : quote;
    } else if (line[i] == '"' || line[i] == '\'') {
      quote = line[i];
    } else if (line[i] == '#') {
      return trimmed(line.substr(0, i));
    }
  }
  open = quote != 0;
  return trimmed(line);
}

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::string header_hint(std::string_view line, std::string_view description) {
  const std::string name(trimmed(line.substr(1, line.find(']') - 1)));
  if (contains(description, "redefine") && !line.starts_with("[["))
    return "; several tables of one kind have two brackets each: [[" + name + "]]";
  if (line.starts_with("[[") && !contains(line, "]]")) return "; close it with two brackets: [[name]]";
  if (!contains(line, "]")) return "; close it with a bracket: [name]";
  return "";
}

bool is_decimal_comma(std::string_view value) {
  const std::size_t comma = value.find(',');
  const auto digits = [](std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (comma == std::string_view::npos) return false;
  std::string_view whole = value.substr(0, comma);
  if (whole.starts_with('-') || whole.starts_with('+')) whole.remove_prefix(1);
  return digits(whole) && digits(value.substr(comma + 1));
}

bool is_flag_in_capitals(std::string_view value) {
  const std::string lower = lower_case(std::string(value));
  return lower != value && (lower == "true" || lower == "false");
}

/// Whether letters or operators stand outside of quotes.
bool has_bare_expression(std::string_view value) {
  char quote = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto c = static_cast<unsigned char>(value[i]);
    if (quote != 0) {
      quote = value[i] == quote ? 0 : quote;
    } else if (c == '"' || c == '\'') {
      quote = value[i];
    } else if (std::isalpha(c) != 0 || c == '*' || c == '/' || c == '(' || c == '^') {
      const bool exponent =
          (c == 'e' || c == 'E') && i > 0 && std::isdigit(static_cast<unsigned char>(value[i - 1])) != 0;
      if (!exponent) return true;
    }
  }
  return false;
}

std::string value_hint(const std::string& key, std::string_view value, std::string_view description) {
  const std::string shown(value);
  if (value.empty()) return "; a value is missing after '='";
  if (is_decimal_comma(value)) {
    std::string point = shown;
    std::ranges::replace(point, ',', '.');
    return "; decimals have a point: " + key + " = " + point;
  }
  if (is_flag_in_capitals(value)) return "; write true or false, in small letters";
  if (value.starts_with('.')) return "; write the zero before the point: 0" + shown;
  if (value.ends_with('.')) return "; write a digit behind the point: " + shown + "0";
  const auto measure = parse_measure(value);
  if (measure && !measure->unit.empty() && parse_unit(measure->unit)) {
    const std::string number = shown.substr(0, shown.size() - measure->unit.size());
    return "; a number with its unit is written { value = " + std::string(trimmed(number)) + ", unit = \"" +
           measure->unit + "\" }, in [parameters]";
  }
  if (contains(description, "inline table"))
    return "; a table in braces stands on one line, with commas between its entries and none at its end";
  if (contains(description, "redefine")) return "; the key stands twice in its table";
  if (value.starts_with('('))
    return "; lists stand in brackets: [1, 2, 3]; expressions in quotes: \"(a + b)/2\"";
  if (value.starts_with('[')) {
    return has_bare_expression(value)
               ? "; put expressions and names in quotes, each for itself: [0, \"-length\", 0]"
               : "; numbers in a list are separated by commas: [1, 2, 3]";
  }
  if (has_bare_expression(value) && !value.starts_with('{') && !contains(value, "\""))
    return "; put expressions and names in quotes: " + key + " = \"" + shown + "\"";
  return "";
}

/// A hint for the line with the error, to follow its message: "; put expressions in quotes: k = \"2*m\"".
/// Empty if none comes to mind. `line` counts from 1; `description` is what the parser says.
std::string toml_hint(std::string_view text, int line, std::string_view description) {
  constexpr std::size_t longest = 200;  // characters of a line that is repeated in a message
  bool open = false;
  const std::string_view here = without_comment(line_of(text, line), open);
  if (here.empty() || here.size() > longest) return "";
  if (here.starts_with("//") || here.starts_with('%')) return "; comments begin with #";
  if (open) return "; a quote is opened here and never closed on this line";
  const std::size_t equals = here.find('=');
  if (here.starts_with('[') && equals == std::string_view::npos) return header_hint(here, description);
  if (contains(description, "expected '='")) return "; write key = value";
  if (equals == std::string_view::npos) return "";
  const std::string_view key = trimmed(here.substr(0, equals));
  return value_hint(std::string(key), trimmed(here.substr(equals + 1)), description);
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
    const SourceLocation where = location(error);
    throw InputError(prefix(path, where) + "not valid TOML: " + std::string(error.description()) +
                     toml_hint(text, where.line, error.description()));
  }
}

}  // namespace eigentrail
