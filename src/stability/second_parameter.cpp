#include "stability/second_parameter.hpp"

#include <cmath>
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

void check_second_range(double from, double to) {
  for (const auto& [key, value] : {std::pair("--second-from", from), std::pair("--second-to", to)}) {
    if (!std::isfinite(value)) throw InputError(std::string(key) + ": is not a finite number");
  }
  if (from == to)
    throw InputError("--second-to: equals --second-from (" + exact_text(from) + "): the window is empty");
}

void require_first_range(const Scene& scene, const OptionTexts& overrides) {
  const std::map<std::string, std::string> given(overrides.begin(), overrides.end());
  const std::vector<const Table*> found = tables(scene, "trace");
  const Table none;
  const Table& trace = found.empty() ? none : *found.front();
  const auto parameter = given.find("parameter");
  for (const std::string key : {"from", "to"}) {
    if (given.contains(key)) continue;
    const std::string option = "--" + key;
    if (parameter != given.end() && scene.parameters.index(parameter->second) &&
        traced_parameter(scene) != parameter->second)
      throw InputError(option + ": is missing; the range in the scene is not that of '" + parameter->second +
                       "'");
    if (trace.find(key) == nullptr)
      throw scene_error(scene, trace.where,
                        "[trace] " + key + ": is missing; expected a number, here or as " + option);
  }
}

std::vector<double> evenly(double from, double to, int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / (n - 1);
    values[static_cast<std::size_t>(i)] = (1.0 - share) * from + share * to;
  }
  return values;
}

std::unique_ptr<Model> model_over_window(const Scene& scene, const TraceOptions& trace,
                                         const SecondRange& second, std::set<int> used, int per_side) {
  const int p_index = scene.parameters.index(trace.parameter).value();
  const int q_index = scene.parameters.index(second.name).value();
  std::vector<Vector> points;
  for (const int n : {2, per_side}) {
    for (const double q : evenly(second.from, second.to, n)) {
      for (const double p : evenly(trace.from, trace.to, n)) {
        Vector& values = points.emplace_back(scene.parameters.declared_values());
        values[p_index] = p;
        values[q_index] = q;
      }
    }
  }
  // Both parameters of the window must enter the model itself.
  used.erase(p_index);
  used.erase(q_index);
  return build_model(scene, {points, used, trace.without});
}

}  // namespace eigentrail
