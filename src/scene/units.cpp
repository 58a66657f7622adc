#include "eigentrail/scene/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace eigentrail {
namespace {

constexpr double pi = std::numbers::pi;

constexpr std::array<std::pair<std::string_view, double>, 51> symbols = {{
    {"1", 1.0},
    {"-", 1.0},
    {"m", 1.0},
    {"km", 1e3},
    {"cm", 1e-2},
    {"mm", 1e-3},
    {"um", 1e-6},
    {"µm", 1e-6},
    {"μm", 1e-6},
    {"nm", 1e-9},
    {"in", 0.0254},
    {"ft", 0.3048},
    {"kg", 1.0},
    {"g", 1e-3},
    {"mg", 1e-6},
    {"t", 1e3},
    {"lb", 0.45359237},
    {"slug", 14.593902937206364},
    {"s", 1.0},
    {"ms", 1e-3},
    {"us", 1e-6},
    {"µs", 1e-6},
    {"μs", 1e-6},
    {"ns", 1e-9},
    {"min", 60.0},
    {"h", 3600.0},
    {"N", 1.0},
    {"mN", 1e-3},
    {"kN", 1e3},
    {"MN", 1e6},
    {"lbf", 4.4482216152605},
    {"Pa", 1.0},
    {"kPa", 1e3},
    {"MPa", 1e6},
    {"GPa", 1e9},
    {"J", 1.0},
    {"kJ", 1e3},
    {"W", 1.0},
    {"kW", 1e3},
    {"rad", 1.0},
    {"mrad", 1e-3},
    {"deg", pi / 180},
    {"rev", 2 * pi},
    {"rpm", 2 * pi / 60},
    {"Hz", 1.0},
    {"kHz", 1e3},
    {"kt", 1852.0 / 3600.0},
    {"mph", 0.44704},
    {"g0", 9.80665},
    {"%", 1e-2},
    {"percent", 1e-2},
}};

std::optional<double> symbol_factor(std::string_view symbol) {
  for (const auto& [name, factor] : symbols) {
    if (name == symbol) return factor;
  }
  return std::nullopt;
}

/// Factor of one unit "symbol" or "symbol^n".
std::optional<double> term_factor(std::string_view term) {
  int power = 1;
  const std::size_t caret = term.find('^');
  if (caret != std::string_view::npos) {
    const char* begin = term.data() + caret + 1;
    const char* end = term.data() + term.size();
    const auto parsed = std::from_chars(begin, end, power);
    if (parsed.ec != std::errc() || parsed.ptr != end || power < -12 || power > 12) return std::nullopt;
  }
  const auto base = symbol_factor(term.substr(0, caret));
  return base ? std::optional(std::pow(*base, power)) : std::nullopt;
}

/// Length in bytes of a separator at the beginning of `text`, 0 if there is none.
std::size_t separator_length(std::string_view text) {
  if (text.starts_with("·")) return std::string_view("·").size();
  return text.starts_with(' ') || text.starts_with('*') || text.starts_with('/') ? 1 : 0;
}

}  // namespace

std::optional<double> unit_factor(std::string_view unit) {
  double factor = 1.0;
  bool divide = false;
  bool expect_term = false;
  while (!unit.empty()) {
    if (const std::size_t length = separator_length(unit); length > 0) {
      if (unit.front() != ' ') {
        if (expect_term) return std::nullopt;
        expect_term = true;
        divide = unit.front() == '/';
      }
      unit.remove_prefix(length);
      continue;
    }
    std::size_t length = 0;
    while (length < unit.size() && separator_length(unit.substr(length)) == 0) ++length;
    const auto term = term_factor(unit.substr(0, length));
    if (!term) return std::nullopt;
    factor = divide ? factor / *term : factor * *term;
    divide = false;
    expect_term = false;
    unit.remove_prefix(length);
  }
  const bool usable = !expect_term && std::isfinite(factor) && factor > 0.0;
  return usable ? std::optional(factor) : std::nullopt;
}

std::optional<double> angular_frequency(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, double>, 8> units = {{{"", 1.0},
                                                                         {"rad/s", 1.0},
                                                                         {"1/s", 1.0},
                                                                         {"Hz", 2 * pi},
                                                                         {"kHz", 2e3 * pi},
                                                                         {"rev/s", 2 * pi},
                                                                         {"rpm", 2 * pi / 60},
                                                                         {"deg/s", pi / 180}}};
  double value = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || !std::isfinite(value)) return std::nullopt;
  std::string_view unit(parsed.ptr, static_cast<std::size_t>(text.data() + text.size() - parsed.ptr));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  for (const auto& [name, factor] : units) {
    if (name == unit) return value * factor;
  }
  return std::nullopt;
}

}  // namespace eigentrail
