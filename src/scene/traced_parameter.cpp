#include "eigentrail/scene/traced_parameter.hpp"

#include <algorithm>

namespace eigentrail {

std::string traced_parameter(const Scene& scene) {
  for (const Table* trace : tables(scene, "trace")) {
    if (const auto* name = entry_as<std::string>(*trace, "parameter")) return *name;
  }
  return "";
}

std::vector<std::string> trimmed_parameters(const Scene& scene) {
  std::vector<std::string> names;
  for (const Table* trim : tables(scene, "trim")) {
    if (const auto* name = entry_as<std::string>(*trim, "unknown")) names.push_back(*name);
  }
  return names;
}

bool is_trimmed(const Scene& scene, const std::string& parameter) {
  const std::vector<std::string> names = trimmed_parameters(scene);
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

}  // namespace eigentrail
