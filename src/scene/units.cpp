#include "eigentrail/scene/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <numbers>
#include <utility>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/measure.hpp"
#include "scene/frequency_unit.hpp"

namespace eigentrail {
namespace {

constexpr double pi = std::numbers::pi;

/// Dimension kg^a m^b s^c A^d K^e.
constexpr Dimension dimension(double kg, double m, double s, double A = 0.0, double K = 0.0) {
  return {{kg, m, s, A, K}};
}
namespace of {
constexpr Dimension number{};
constexpr Dimension length = dimension(0, 1, 0), mass = dimension(1, 0, 0), duration = dimension(0, 0, 1);
constexpr Dimension rate = dimension(0, 0, -1), velocity = dimension(0, 1, -1);
constexpr Dimension acceleration = dimension(0, 1, -2), force = dimension(1, 1, -2);
constexpr Dimension pressure = dimension(1, -1, -2), energy = dimension(1, 2, -2);
constexpr Dimension power = dimension(1, 2, -3), viscosity = dimension(1, -1, -1);
constexpr Dimension volume = dimension(0, 3, 0);
constexpr Dimension current = dimension(0, 0, 0, 1), temperature = dimension(0, 0, 0, 0, 1);
}  // namespace of

constexpr double pound_force = 0.45359237 * 9.80665;

/// Units with SI prefixes: mm, kN, GPa, mrad.
struct Symbol {
  std::string_view name;
  Unit unit;
};
constexpr std::array<Symbol, 20> with_prefixes = {{
    {"m", {1.0, of::length}},
    {"g", {1e-3, of::mass}},
    {"s", {1.0, of::duration}},
    {"N", {1.0, of::force}},
    {"Pa", {1.0, of::pressure}},
    {"bar", {1e5, of::pressure}},
    {"J", {1.0, of::energy}},
    {"W", {1.0, of::power}},
    {"rad", {1.0, of::number}},
    {"Hz", {2 * pi, of::rate, true}},
    {"A", {1.0, of::current}},
    {"V", {1.0, dimension(1, 2, -3, -1)}},
    {"ohm", {1.0, dimension(1, 2, -3, -2)}},
    {"Ω", {1.0, dimension(1, 2, -3, -2)}},
    {"C", {1.0, dimension(0, 0, 1, 1)}},
    {"F", {1.0, dimension(-1, -2, 4, 2)}},
    {"H", {1.0, dimension(1, 2, -2, -2)}},
    {"Wb", {1.0, dimension(1, 2, -2, -1)}},
    {"T", {1.0, dimension(1, 0, -2, -1)}},
    {"K", {1.0, of::temperature}},
}};
constexpr std::array<std::pair<std::string_view, double>, 13> prefixes = {{{"n", 1e-9},
                                                                           {"u", 1e-6},
                                                                           {"µ", 1e-6},
                                                                           {"μ", 1e-6},
                                                                           {"m", 1e-3},
                                                                           {"c", 1e-2},
                                                                           {"d", 1e-1},
                                                                           {"da", 1e1},
                                                                           {"h", 1e2},
                                                                           {"k", 1e3},
                                                                           {"M", 1e6},
                                                                           {"G", 1e9},
                                                                           {"T", 1e12}}};

constexpr std::array<Symbol, 36> without_prefixes = {{
    {"1", {}},
    {"-", {}},
    {"%", {1e-2, of::number}},
    {"percent", {1e-2, of::number}},
    {"in", {0.0254, of::length}},
    {"ft", {0.3048, of::length}},
    {"yd", {0.9144, of::length}},
    {"mi", {1609.344, of::length}},
    {"nmi", {1852.0, of::length}},
    {"t", {1e3, of::mass}},
    {"lb", {0.45359237, of::mass}},
    {"oz", {0.45359237 / 16, of::mass}},
    {"slug", {pound_force / 0.3048, of::mass}},
    {"min", {60.0, of::duration}},
    {"h", {3600.0, of::duration}},
    {"d", {86400.0, of::duration}},
    {"lbf", {pound_force, of::force}},
    {"kip", {1e3 * pound_force, of::force}},
    {"kgf", {9.80665, of::force}},
    {"dyn", {1e-5, of::force}},
    {"psi", {pound_force / (0.0254 * 0.0254), of::pressure}},
    {"ksi", {1e3 * pound_force / (0.0254 * 0.0254), of::pressure}},
    {"psf", {pound_force / (0.3048 * 0.3048), of::pressure}},
    {"atm", {101325.0, of::pressure}},
    {"hp", {550 * 0.3048 * pound_force, of::power}},
    {"l", {1e-3, of::volume}},
    {"L", {1e-3, of::volume}},
    {"P", {0.1, of::viscosity}},
    {"cP", {1e-3, of::viscosity}},
    {"deg", {pi / 180, of::number, true}},
    {"°", {pi / 180, of::number, true}},
    {"rev", {2 * pi, of::number, true}},
    {"rpm", {2 * pi / 60, of::rate, true}},
    {"kt", {1852.0 / 3600.0, of::velocity}},
    {"mph", {0.44704, of::velocity}},
    {"g0", {9.80665, of::acceleration}},
}};

/// A unit by its symbol alone. Prefixes come last: "min" is a minute, not a milliinch.
std::optional<Unit> symbol_unit(std::string_view symbol) {
  for (const Symbol& known : without_prefixes) {
    if (known.name == symbol) return known.unit;
  }
  for (const Symbol& known : with_prefixes) {
    if (!symbol.ends_with(known.name)) continue;
    const std::string_view prefix = symbol.substr(0, symbol.size() - known.name.size());
    if (prefix.empty()) return known.unit;
    for (const auto& [name, factor] : prefixes) {
      if (name == prefix) return Unit{factor * known.unit.factor, known.unit.dimension, known.unit.angle};
    }
  }
  return std::nullopt;
}

Unit power_of(const Unit& unit, int exponent) {
  return {std::pow(unit.factor, exponent), pow(unit.dimension, exponent), unit.angle && exponent != 0};
}

/// One unit "symbol" or "symbol^n".
std::optional<Unit> term_unit(std::string_view term) {
  const std::size_t caret = term.find('^');
  const auto exponent =
      caret == std::string_view::npos ? std::optional(1) : parsed_number<int>(term.substr(caret + 1));
  if (!exponent || *exponent < -12 || *exponent > 12) return std::nullopt;
  const auto base = symbol_unit(term.substr(0, caret));
  return base ? std::optional(power_of(*base, *exponent)) : std::nullopt;
}

/// What stands between units, with a point in the middle written as '*'.
constexpr std::string_view separators = " */";

}  // namespace

std::optional<Unit> parse_unit(std::string_view unit) {
  const std::string text = replaced_all(std::string(unit), "·", "*");
  std::string_view rest = text;
  Unit result;
  bool divide = false;
  bool expect_term = false;
  while (!rest.empty()) {
    if (separators.find(rest.front()) != std::string_view::npos) {
      if (rest.front() != ' ') {
        if (expect_term) return std::nullopt;
        expect_term = true;
        divide = rest.front() == '/';
      }
      rest.remove_prefix(1);
      continue;
    }
    const std::size_t length = std::min(rest.find_first_of(separators), rest.size());
    const auto term = term_unit(rest.substr(0, length));
    if (!term) return std::nullopt;
    result.factor = divide ? result.factor / term->factor : result.factor * term->factor;
    result.dimension = divide ? result.dimension / term->dimension : result.dimension * term->dimension;
    result.angle = result.angle || term->angle;
    divide = false;
    expect_term = false;
    rest.remove_prefix(length);
  }
  const bool usable = !expect_term && std::isfinite(result.factor) && result.factor > 0.0;
  return usable ? std::optional(result) : std::nullopt;
}

std::optional<double> unit_factor(std::string_view unit) {
  const auto parsed = parse_unit(unit);
  return parsed ? std::optional(parsed->factor) : std::nullopt;
}

std::optional<double> angular_frequency(std::string_view text) {
  const auto measure = parse_measure(text);
  if (!measure || measure->unit.empty()) return measure ? std::optional(measure->number) : std::nullopt;
  const auto unit = parse_unit(measure->unit);
  return unit && unit->dimension == of::rate ? std::optional(measure->number * unit->factor) : std::nullopt;
}

FrequencyUnit frequency_unit(const std::string& parameter_unit) {
  const auto unit = parse_unit(parameter_unit), hertz = parse_unit("Hz");
  if (unit && unit->dimension == hertz->dimension) return {parameter_unit, unit->factor};
  return {"Hz", hertz->factor};
}

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
