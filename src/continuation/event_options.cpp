#include "eigentrail/continuation/event_options.hpp"

#include <algorithm>
#include <array>

#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

/// Numbers without parameters, all of which `accepted` admits.
template <class Accepted>
std::vector<double> read_constants(TableReader& table, const char* key, const char* expected,
                                   Accepted&& accepted) {
  std::vector<double> values;
  if (!table.has(key)) return values;
  for (const Expression& expression : table.list(key)) {
    if (!expression.is_constant()) table.fail(key, "expected numbers without parameters");
    const double value = expression.evaluate(std::span<const double>());
    if (!accepted(value)) table.fail(key, std::string(expected) + "; found " + exact_text(value));
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

/// The traced parameter as the excitation frequency, if it is one. Turns are counted in Hz, too.
Expression traced_frequency(const Scene& scene, const std::string& traced, const TableReader& table) {
  constexpr std::array<std::string_view, 9> angular{"",    "rad/s", "rad s^-1", "1/s",   "s^-1",
                                                    "rpm", "rev/s", "deg/s",    "mrad/s"};
  constexpr std::array<std::string_view, 2> turns{"Hz", "kHz"};
  const auto index = scene.parameters.index(traced);
  const std::string unit = index ? scene.parameters[static_cast<std::size_t>(*index)].unit : "";
  const auto is_one_of = [&](const auto& units) {
    return std::find(units.begin(), units.end(), unit) != units.end();
  };
  if (!is_one_of(angular) && !is_one_of(turns)) {
    table.fail("harmonics", "of what frequency? '" + traced + "' is in " + unit +
                                "; give `excitation`, in rad/s, as an expression of the parameters");
  }
  return Expression::parse((is_one_of(turns) ? "2 * pi * " : "") + traced, scene.parameters.names());
}

}  // namespace

EventOptions read_event_options(const Scene& scene, const std::string& traced, std::set<int>& used) {
  const auto found = tables(scene, "events");
  EventOptions options;
  if (found.empty()) return options;
  if (found.size() > 1)
    throw scene_error(scene, found[1]->where, "[events]: a scene has one of these at most");
  TableReader table(scene, *found.front(), "[events]", used);
  options.damping_ratios =
      read_constants(table, "damping_ratio", "must lie between -1 and 1", is_damping_ratio);
  // Modes of damping ratio zero are those on the imaginary axis.
  std::erase(options.damping_ratios, 0.0);
  options.harmonics = read_constants(table, "harmonics", "must be positive",
                                     [](double n) { return n > 0.0 && std::isfinite(n); });
  if (table.has("excitation")) {
    if (options.harmonics.empty()) table.fail("excitation", "is of no use without `harmonics`");
    options.excitation = table.expression("excitation");
  } else if (!options.harmonics.empty() && scene.parameters.index(traced)) {
    // A parameter that does not exist is reported with the other options.
    options.excitation = traced_frequency(scene, traced, table);
  }
  if (table.has("extrema")) options.extrema = table.flag("extrema");
  table.finish();
  return options;
}

}  // namespace eigentrail
