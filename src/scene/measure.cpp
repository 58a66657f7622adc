#include "eigentrail/scene/measure.hpp"

#include <cctype>
#include <charconv>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {

std::optional<Measure> parse_measure(std::string_view text) {
  text = trimmed(text, " ");
  if (text.starts_with('+')) text.remove_prefix(1);
  // Not inf, nan, nor the beginning of the name of a parameter.
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.empty() || (digits[0] != '.' && std::isdigit(static_cast<unsigned char>(digits[0])) == 0))
    return std::nullopt;
  Measure measure;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), measure.number);
  if (parsed.ec != std::errc()) return std::nullopt;
  const std::string_view rest = trimmed({parsed.ptr, text.data() + text.size()}, " ");
  // Units begin with a letter, a sign such as ° or %, or the 1 of 1/s. Operators make an expression.
  const bool begins_unit = rest.empty() || rest[0] == '%' || rest[0] == '1' ||
                           std::isalpha(static_cast<unsigned char>(rest[0])) != 0 ||
                           (static_cast<unsigned char>(rest[0]) & 0x80U) != 0;
  if (!begins_unit) return std::nullopt;
  measure.unit = rest;
  return measure;
}

UnitValue value_in_unit_of(const Parameter& parameter, const Measure& measure) {
  if (measure.unit.empty()) return {measure.number, ""};
  const auto unit = parse_unit(measure.unit);
  if (!unit) return {0.0, "unit '" + measure.unit + "' is not known; " + unit_suggestion(measure.unit)};
  if (parameter.dimension && !(*parameter.dimension == unit->dimension)) {
    return {0.0, exact_text(measure.number) + " " + measure.unit + " does not fit " + parameter.name +
                     ", which is in " + parameter.unit};
  }
  const double own = parameter.dimension ? parameter.factor : 1.0;
  if (unit->factor == own) return {measure.number, ""};  // no rounding
  return {measure.number * unit->factor / own, ""};
}

}  // namespace eigentrail
