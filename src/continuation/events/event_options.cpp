#include "eigentrail/continuation/event_options.hpp"

#include <algorithm>

#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/expression_dimension.hpp"

namespace eigentrail {
namespace {

/// The numbers that a scene requests for one kind of event, without repetitions. They may not depend on
/// parameters.
std::vector<double> read_numbers(TableReader& table, const EventRequest& request) {
  const std::string key(request.key);
  std::vector<double> values;
  if (!table.has(key)) return values;
  for (const Expression& expression : table.list(key)) {
    if (!expression.is_constant()) table.fail(key, "expected numbers without parameters");
    const double value = expression.evaluate(std::span<const double>());
    if (!request.accepts(value))
      table.fail(key, std::string(request.expected) + "; found " + exact_text(value));
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

/// The traced parameter as the excitation frequency: its SI value in rad/s. Fails if its unit is not one of a
/// frequency. A parameter without a unit is in rad/s.
Expression traced_frequency(const Scene& scene, const std::string& traced, const TableReader& table) {
  const auto index = scene.parameters.index(traced);
  const Expression frequency = Expression::parse(traced, scene.parameters.names());
  const std::string fault = dimension_fault(frequency, scene.parameters.list(), "rad/s");
  if (!fault.empty()) {
    table.fail("harmonics", "of what frequency? '" + traced + "' is in " +
                                scene.parameters[static_cast<std::size_t>(*index)].unit +
                                "; give `excitation`, in rad/s, as an expression of the parameters");
  }
  return frequency;
}

}  // namespace

std::vector<double> EventOptions::values(EventKind kind) const {
  std::vector<double> all;
  for (const WantedEvent& event : wanted) {
    if (event.kind == kind) all.push_back(event.value);
  }
  return all;
}

EventOptions read_event_options(const Scene& scene, const std::string& traced, std::set<int>& used) {
  const auto found = tables(scene, "events");
  EventOptions options;
  if (found.empty()) return options;
  if (found.size() > 1)
    throw scene_error(scene, found[1]->where, "[events]: a scene has one of these at most");
  TableReader table(scene, *found.front(), "[events]", used);
  bool is_excited = false;
  for (const EventKindInfo& kind : event_kinds()) {
    if (kind.request.key.empty()) continue;
    for (const double value : read_numbers(table, kind.request)) {
      // A damping ratio or decrement of zero is flutter, which every trace looks for.
      if (value != 0.0) options.wanted.push_back({kind.kind, value});
      is_excited = is_excited || kind.request.of_excitation;
    }
  }
  if (table.has("excitation")) {
    if (!is_excited) table.fail("excitation", "is of no use without `harmonics`");
    options.excitation = table.expression("excitation", "rad/s");
  } else if (is_excited && scene.parameters.index(traced)) {
    // A traced parameter that does not exist is reported where the other options are read.
    options.excitation = traced_frequency(scene, traced, table);
  }
  if (table.has("extrema")) options.extrema = table.flag("extrema");
  table.finish();
  return options;
}

}  // namespace eigentrail
