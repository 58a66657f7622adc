// Names for units in messages: the usual SI unit of a dimension, and what a mistaken unit may mean.
#include <array>
#include <map>
#include <sstream>
#include <utility>

#include "core/texts.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

/// SI units by which dimensions of mechanics go.
constexpr std::array<std::string_view, 32> usual_units = {
    "1",    "m",      "m^2",    "m^3",  "kg",     "s",   "1/s",  "1/s^2", "1/m", "m/s",   "m/s^2",
    "N",    "N/m",    "N s/m",  "N m",  "N m s",  "Pa",  "Pa s", "W",     "N s", "N m^2", "N/m^2",
    "kg/m", "kg/m^2", "kg/m^3", "kg m", "kg m^2", "m/N", "A",    "V",     "N/A", "K"};

/// Words and habits for units, in lower case.
const std::map<std::string_view, std::string_view>& habits() {
  static const std::map<std::string_view, std::string_view> table = {
      {"sec", "s"},        {"second", "s"},    {"seconds", "s"}, {"minute", "min"},  {"minutes", "min"},
      {"hour", "h"},       {"hours", "h"},     {"meter", "m"},   {"meters", "m"},    {"metre", "m"},
      {"metres", "m"},     {"newton", "N"},    {"newtons", "N"}, {"kilogram", "kg"}, {"kilograms", "kg"},
      {"kgs", "kg"},       {"hertz", "Hz"},    {"cps", "Hz"},    {"radian", "rad"},  {"radians", "rad"},
      {"degree", "deg"},   {"degrees", "deg"}, {"degs", "deg"},  {"turn", "rev"},    {"turns", "rev"},
      {"revs", "rev"},     {"rps", "rev/s"},   {"u/min", "rpm"}, {"r/min", "rpm"},   {"rev/min", "rpm"},
      {"knot", "kt"},      {"knots", "kt"},    {"kts", "kt"},    {"lbs", "lb"},      {"pound", "lb"},
      {"pounds", "lb"},    {"feet", "ft"},     {"foot", "ft"},   {"inch", "in"},     {"inches", "in"},
      {"nm", "N m"},       {"knm", "kN m"},    {"nmm", "N mm"},  {"ns", "N s"},      {"kgm", "kg m"},
      {"kgm^2", "kg m^2"}, {"kgm2", "kg m^2"}, {"joule", "J"},   {"watt", "W"},      {"pascal", "Pa"},
      {"tonne", "t"},      {"tonnes", "t"},    {"ton", "t"},     {"kph", "km/h"},    {"kmh", "km/h"},
      {"g's", "g0"},       {"gee", "g0"}};
  return table;
}

/// Powers written as in print: "m²", or with two stars: "m**2".
std::string with_carets(std::string text) {
  for (const auto& [from, to] : {std::pair("²", "^2"), std::pair("³", "^3"), std::pair("**", "^"),
                                 std::pair("⁻¹", "^-1"), std::pair(".", " ")})
    text = replaced_all(text, from, to);
  return text;
}

/// The usual unit that differs from `symbol` in capitals alone; empty if there is none.
std::string with_other_capitals(const std::string& symbol) {
  constexpr std::array<std::string_view, 20> usual = {"kN",  "N",   "MN", "Hz", "kHz", "Pa", "kPa",
                                                      "MPa", "GPa", "J",  "kJ", "MJ",  "W",  "kW",
                                                      "MW",  "rad", "kg", "A",  "V",   "K"};
  for (const std::string_view unit : usual) {
    if (equal_words(unit, symbol)) return std::string(unit);
  }
  return "";
}

/// A unit that is understood, for one symbol; empty if none comes to mind.
std::string repaired_symbol(const std::string& symbol) {
  if (parse_unit(symbol)) return symbol;
  const std::string lower = lower_case(symbol);
  if (const auto word = habits().find(lower); word != habits().end()) return std::string(word->second);
  if (parse_unit(lower)) return lower;
  if (const std::string other = with_other_capitals(symbol); !other.empty()) return other;
  // A power without its caret: "m2", "s-1".
  const std::size_t digits = symbol.find_first_of("-0123456789");
  if (digits != std::string::npos && digits > 0 && symbol[digits - 1] != '^') {
    const std::string power = symbol.substr(0, digits) + "^" + symbol.substr(digits);
    if (parse_unit(power)) return power;
  }
  for (std::size_t at = 1; at < symbol.size(); ++at) {  // two units without a space: "Nms"
    const std::string apart = symbol.substr(0, at) + " " + symbol.substr(at);
    if (parse_unit(apart)) return apart;
  }
  return "";
}

/// The text with every symbol repaired; empty if that does not make a unit. Parentheses have no meaning in
/// units: those around one symbol are left out, those around several cannot be.
std::string repaired_unit(std::string_view unit) {
  const std::string whole = lower_case(std::string(unit));
  if (const auto word = habits().find(whole); word != habits().end()) return std::string(word->second);
  const std::string text = with_carets(std::string(unit));
  std::string result;
  std::string symbol;
  bool inside = false;
  bool understood = true;
  const auto finish = [&] {
    const std::string repaired = symbol.empty() ? "" : repaired_symbol(symbol);
    understood = understood && (symbol.empty() || !repaired.empty());
    result += repaired;
    symbol.clear();
  };
  for (const char c : text) {
    if (c == '(' || c == ')') {
      inside = c == '(';
    } else if (c == ' ' || c == '*' || c == '/') {
      if (inside) return "";
      finish();
      result += c;
    } else {
      symbol += c;
    }
  }
  finish();
  return understood && parse_unit(result) ? result : "";
}

}  // namespace

std::string si_unit(const Dimension& dimension) {
  for (const std::string_view unit : usual_units) {
    if (parse_unit(unit)->dimension == dimension) return std::string(unit);
  }
  std::ostringstream text;
  constexpr std::array<std::string_view, 5> base = {"kg", "m", "s", "A", "K"};
  for (std::size_t i = 0; i < base.size(); ++i) {
    const double power = dimension.powers[i];
    if (std::abs(power) < 1e-9) continue;
    text << (text.tellp() > 0 ? " " : "") << base[i];
    if (power != 1.0) text << '^' << power;
  }
  return text.str();
}

std::string unit_suggestion(std::string_view unit) {
  const std::string repaired = unit.size() > 60 ? "" : repaired_unit(unit);
  if (!repaired.empty() && repaired != unit) return "did you mean '" + repaired + "'?";
  return "write it like \"rad/s\", \"rpm\", \"mm\", \"kg m^2\" or \"N m^-1\"";
}

}  // namespace eigentrail
