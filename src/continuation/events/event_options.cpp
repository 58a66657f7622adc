#include "eigentrail/continuation/event_options.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/expression_dimension.hpp"
#include "eigentrail/scene/measure.hpp"

namespace eigentrail {
namespace {

/// The value of a number without parameters.
double constant(const TableReader& table, const std::string& key, const Expression& expression) {
  if (!expression.is_constant()) table.fail(key, "expected numbers without parameters");
  return expression.evaluate(std::span<const double>());
}

/// The numbers that a scene requests for one kind of event, without repetitions. They may not depend on
/// parameters.
std::vector<double> read_numbers(TableReader& table, const EventRequest& request) {
  const std::string key(request.key);
  std::vector<double> values;
  if (!table.has(key)) return values;
  for (const Expression& expression : table.list(key)) {
    const double value = constant(table, key, expression);
    if (!request.accepts(value))
      table.fail(key, std::string(request.expected) + "; found " + exact_text(value));
    if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
  }
  return values;
}

/// The different speeds of the shafts.
std::vector<Expression> speeds_of_shafts(const Scene& scene, std::set<int>& used) {
  std::vector<Expression> speeds;
  for (const Table* shaft : tables(scene, "shaft")) {
    TableReader table(scene, *shaft, "[[shaft]]", used);
    const Expression speed = table.has("speed") ? table.expression("speed", "rad/s") : Expression(0.0);
    if (std::find(speeds.begin(), speeds.end(), speed) == speeds.end()) speeds.push_back(speed);
  }
  return speeds;
}

/// The frequency of the excitation where none is given: the traced parameter, if it is a frequency, else the
/// speed of the shafts. A parameter without a unit is in rad/s where there are none. Fails where no frequency
/// is meant for certain.
Expression usual_excitation(const Scene& scene, const std::string& traced, const TableReader& table,
                            std::set<int>& used) {
  const Expression parameter = Expression::parse(traced, scene.parameters.names());
  const std::string& unit = scene.parameters.at(traced).unit;
  const bool may_be = dimension_fault(parameter, scene.parameters.list(), "rad/s").empty();
  const std::vector<Expression> speeds = speeds_of_shafts(scene, used);
  const bool turns = std::find(speeds.begin(), speeds.end(), parameter) != speeds.end();
  if (may_be && (!unit.empty() || speeds.empty() || turns)) return parameter;
  if (speeds.size() == 1 && !speeds.front().is_constant()) return speeds.front();
  table.fail("harmonics", "of what frequency? '" + traced + "' " +
                              (unit.empty() ? "has no unit" : "is in " + unit) +
                              "; give `excitation`, in rad/s, as an expression of the parameters");
}

/// Replaces texts with units ("3000 rpm") by numbers in the unit of the traced parameter, in lists too.
void take_units(const Scene& scene, const std::string& key, const Parameter& traced, Value& value) {
  if (auto* list = std::get_if<Array>(&value.data)) {
    for (Value& item : *list) take_units(scene, key, traced, item);
  }
  const auto* text = std::get_if<std::string>(&value.data);
  const auto measure = text == nullptr ? std::nullopt : parse_measure(*text);
  if (!measure) return;
  const UnitValue found = value_in_unit_of(traced, *measure);
  if (!found.fault.empty()) throw scene_error(scene, value.where, "[events] " + key + ": " + found.fault);
  value.data = found.value;
}

/// The table [events] with operating ranges in the unit of the traced parameter.
Table with_plain_ranges(const Scene& scene, const std::string& traced, Table events) {
  for (auto& [key, value] : events.entries) {
    if (key == "operating_range" && scene.parameters.index(traced))
      take_units(scene, key, scene.parameters.at(traced), value);
  }
  return events;
}

/// One pair [from, to], or a list of pairs, in the unit of the traced parameter.
std::vector<OperatingRange> read_ranges(TableReader& table) {
  const std::string key = "operating_range";
  std::vector<OperatingRange> ranges;
  for (const std::vector<Expression>& row : table.matrix(key)) {
    if (row.size() != 2) table.fail(key, "expected [from, to], or a list of such pairs");
    const OperatingRange range{constant(table, key, row[0]), constant(table, key, row[1])};
    if (!(range.from >= 0.0 && range.from <= range.to && std::isfinite(range.to)))
      table.fail(
          key, "expected 0 <= from <= to; found " + exact_text(range.from) + " and " + exact_text(range.to));
    ranges.push_back(range);
  }
  return ranges;
}

OperatingRanges read_operating_ranges(TableReader& table, bool is_excited) {
  const std::string key = "separation_margin";
  OperatingRanges operating;
  if (table.has("operating_range")) {
    if (!is_excited) table.fail("operating_range", "is of no use without `harmonics`");
    operating.ranges = read_ranges(table);
  }
  if (!table.has(key)) return operating;
  if (operating.ranges.empty()) table.fail(key, "is of no use without `operating_range`");
  const double margin = constant(table, key, table.expression(key, ""));
  if (!(margin >= 0.0 && margin < 1.0))
    table.fail(key, "must be a fraction, at least 0 and below 1; found " + exact_text(margin));
  operating.margin = margin;
  return operating;
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
  const Table events = with_plain_ranges(scene, traced, *found.front());
  TableReader table(scene, events, "[events]", used);
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
    options.excitation = usual_excitation(scene, traced, table, used);
  }
  options.operating = read_operating_ranges(table, is_excited);
  if (table.has("extrema")) options.extrema = table.flag("extrema");
  if (table.has("veerings")) options.veerings = table.flag("veerings");
  table.finish();
  return options;
}

}  // namespace eigentrail
