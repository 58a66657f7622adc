#include "model/family_tables.hpp"

#include <algorithm>
#include <charconv>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {

const Table& only_table(const Scene& scene, const std::string& name) {
  const std::vector<const Table*> found = tables(scene, name);
  if (found.empty()) throw InputError(scene.path + ": [" + name + "]: is an empty list");
  if (found.size() > 1) throw scene_error(scene, found[1]->where, "[" + name + "]: a scene has one of these");
  return *found.front();
}

int traced_index(const Scene& scene, const std::string& name, const std::string& what) {
  if (const auto index = scene.parameters.index(traced_parameter(scene))) return *index;
  throw InputError(scene.path + ": [trace] parameter: a scene with [" + name + "] names here " + what);
}

std::string unknown_member(const Hdf5File& file, const std::vector<std::string>& known) {
  for (const std::string& name : file.members("/")) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      return "unknown '" + name + "' in it; " + suggestion(name, known);
  }
  return "";
}

std::string fault_of_names(const std::vector<std::string>& names, Eigen::Index n) {
  if (!names.empty() && static_cast<Eigen::Index>(names.size()) != n)
    return "has " + std::to_string(names.size()) + " names for " + std::to_string(n) + " states";
  const auto same = first_repetition(names);
  return same ? "has '" + names[same->first] + "' twice, for states " + std::to_string(same->first + 1) +
                    " and " + std::to_string(same->second + 1) + "; give every state a name of its own"
              : "";
}

std::optional<int> power_in(const std::string& name) {
  int power = 0;
  const char* const end = name.data() + name.size();
  const auto parsed = std::from_chars(name.data(), end, power);
  return parsed.ec == std::errc() && parsed.ptr == end ? std::optional(power) : std::nullopt;
}

Expression power_of_parameter(int parameter, int power) {
  Expression result = 1.0;
  for (int i = 0; i < power; ++i) result = result * Expression::of_parameter(parameter);
  return result;
}

ModelDescription describe_states(Eigen::Index n, const std::vector<std::string>& names,
                                 const std::vector<std::string>& units) {
  ModelDescription description;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    description.coordinate_names.push_back(names.empty() ? "x" + std::to_string(i + 1) : names[i]);
    description.coordinate_units.push_back(units.empty() || units[i].empty() ? "1" : units[i]);
  }
  return description;
}

}  // namespace eigentrail
