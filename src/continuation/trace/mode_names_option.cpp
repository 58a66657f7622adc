#include "continuation/trace/mode_names_option.hpp"

#include "continuation/trace/mode_choice_option.hpp"
#include "eigentrail/scene/units.hpp"

namespace eigentrail {
namespace {

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
