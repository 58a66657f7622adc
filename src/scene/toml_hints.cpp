#include "scene/toml_hints.hpp"

#include <algorithm>
#include <cctype>

#include "core/texts.hpp"
#include "core/trimmed.hpp"
#include "eigentrail/scene/measure.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

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
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
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
    std::replace(point.begin(), point.end(), ',', '.');
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

}  // namespace

std::string toml_hint(std::string_view text, int line, std::string_view description) {
  constexpr std::size_t longest = 200;  // characters of a line that is repeated in a message
  bool open = false;
  const std::string_view here = without_comment(line_of(text, line), open);
  if (here.empty() || here.size() > longest) return "";
  if (here.starts_with("//") || here.starts_with('%')) return "; comments begin with #";
  if (open) return "; a quote is opened here and never closed on this line";
  const std::size_t equals = here.find('=');
  if (here.starts_with('[') && equals == std::string_view::npos) return header_hint(here, description);
  if (equals == std::string_view::npos)
    return contains(description, "expected '='") ? "; write key = value" : "";
  const std::string_view key = trimmed(here.substr(0, equals));
  if (contains(description, "expected '='")) return "; write key = value";
  return value_hint(std::string(key), trimmed(here.substr(equals + 1)), description);
}

}  // namespace eigentrail
