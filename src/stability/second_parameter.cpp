#include "stability/second_parameter.hpp"

#include <map>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {

void check_second_parameter(const Scene& scene, const std::string& second, const std::string& first) {
  const Parameters& parameters = scene.parameters;
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw InputError("--second: " + message);
  };
  require(parameters.index(second).has_value(),
          "no parameter is called '" + second + "'; " + suggestion(second, parameters.names()));
  require(second != first,
          "'" + second + "' is the first parameter already; choose another one, or give --parameter");
  require(!is_trimmed(scene, second),
          "'" + second + "' is the unknown of a [[trim]]; vary another parameter");
  require(!parameters.at(second).definition,
          "'" + second + "' is defined by an expression; vary one of the parameters in it");
}

void require_first_range(const Scene& scene, const OptionTexts& overrides) {
  const std::map<std::string, std::string> given(overrides.begin(), overrides.end());
  const std::vector<const Table*> found = tables(scene, "trace");
  const Table none;
  const Table& trace = found.empty() ? none : *found.front();
  const auto parameter = given.find("parameter");
  for (const std::string key : {"from", "to"}) {
    if (given.contains(key)) continue;
    const std::string option = "--first-" + key;
    if (parameter != given.end() && scene.parameters.index(parameter->second) &&
        traced_parameter(scene) != parameter->second)
      throw InputError(option + ": is missing; the range in the scene is not that of '" + parameter->second +
                       "'");
    if (trace.find(key) == nullptr)
      throw scene_error(scene, trace.where,
                        "[trace] " + key + ": is missing; expected a number, here or as " + option);
  }
}

}  // namespace eigentrail
