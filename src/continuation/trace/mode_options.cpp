#include "continuation/trace/mode_options.hpp"

#include <cmath>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

/// Frequencies in rad/s, at least 0.
std::vector<double> frequencies(TableReader& table, const std::string& key) {
  std::vector<double> values;
  for (const std::string& text : table.texts(key)) {
    const auto value = angular_frequency(text);
    if (!value || *value < 0.0)
      table.fail(
          key, "expected a frequency such as \"3 Hz\", \"200 rpm\" or 18.8 (rad/s), found \"" + text + "\"");
    values.push_back(*value);
  }
  return values;
}

/// The number of a key of a table, which may not depend on parameters.
double constant_number(TableReader& table, const std::string& key) {
  const Expression expression = table.expression(key);
  if (!expression.is_constant()) table.fail(key, "expected a number without parameters");
  return expression.evaluate(std::span<const double>());
}

GivenName read_name(TableReader& names, const std::string& name) {
  GivenName given{name};
  if (name.empty()) names.fail(name, "is an empty name");
  if (names.is_table(name)) {
    TableReader shape = names.table(name);
    bool moves = false;
    for (const std::string& coordinate : shape.keys()) {
      given.shape.emplace_back(coordinate, constant_number(shape, coordinate));
      moves = moves || given.shape.back().second != 0.0;
    }
    if (!moves)
      names.fail(name, "expected coordinates and amounts, such as { \"node 3: x\" = 1 }; all are zero");
    return given;
  }
  const std::vector<std::string> texts = names.texts(name);
  const std::string text = texts.size() == 1 ? texts.front() : "";
  if (text.empty())
    names.fail(name,
               "expected a frequency (\"1.2 Hz\"), a part of a mode's own name (\"blade lag\"), or "
               "coordinates and amounts");
  const auto frequency = angular_frequency(text);
  if (!frequency) {
    given.moves = text;
  } else if (*frequency < 0.0) {
    names.fail(name, "expected a frequency of at least 0, found " + text);
  } else {
    given.frequency = *frequency;
  }
  return given;
}

}  // namespace

ModeChoice read_mode_choice(TableReader table) {
  ModeChoice choice;
  if (table.has("count")) {
    const double count = constant_number(table, "count");
    if (!(count >= 1.0 && count <= 1e9 && count == std::floor(count)))
      table.fail("count", "expected a whole number of at least 1, found " + exact_text(count));
    choice.count = static_cast<int>(count);
  }
  if (table.has("band")) {
    const std::vector<double> ends = frequencies(table, "band");
    if (ends.size() != 2 || !(ends[0] < ends[1]))
      table.fail("band", "expected two frequencies, the lower one first: [\"0.05 Hz\", \"3 Hz\"]");
    choice.band = FrequencyBand{ends[0], ends[1]};
  }
  if (table.has("damping_below")) {
    choice.damping_below = constant_number(table, "damping_below");
    if (!(*choice.damping_below > -1.0 && *choice.damping_below <= 1.0))
      table.fail("damping_below",
                 "must lie above -1, and be 1 at most; found " + exact_text(*choice.damping_below));
  }
  if (table.has("near")) {
    const std::vector<double> place = frequencies(table, "near");
    if (place.size() != 1) table.fail("near", "expected one frequency");
    choice.near = place.front();
    if (!choice.count && !choice.band)
      table.fail("near", "says where to look; say also how many modes are wanted: count = 6");
  }
  table.finish();
  return choice;
}

std::vector<GivenName> read_mode_names(const Scene& scene, std::set<int>& used) {
  const auto found = tables(scene, "modes");
  if (found.empty()) return {};
  if (found.size() > 1)
    throw scene_error(scene, found[1]->where, "[modes]: a scene has one of these at most");
  TableReader table(scene, *found.front(), "[modes]", used);
  std::vector<GivenName> given;
  if (table.has("names")) {
    if (!table.is_table("names"))
      table.fail("names",
                 "expected names and what they stand for: { surge = \"0.01 Hz\", lag = \"blade lag\" }");
    TableReader names = table.table("names");
    for (const std::string& name : names.keys()) given.push_back(read_name(names, name));
    names.finish();
  }
  table.finish();
  return given;
}

}  // namespace eigentrail
