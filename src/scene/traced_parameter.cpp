#include "eigentrail/scene/traced_parameter.hpp"

#include <algorithm>

namespace eigentrail {

std::string traced_parameter(const Scene& scene) {
  for (const Table* trace : tables(scene, "trace")) {
    const Value* value = trace->find("parameter");
    const auto* name = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
    if (name != nullptr) return *name;
  }
  return "";
}

std::vector<std::string> trimmed_parameters(const Scene& scene) {
  std::vector<std::string> names;
  for (const Table* trim : tables(scene, "trim")) {
    const Value* unknown = trim->find("unknown");
    const auto* name = unknown == nullptr ? nullptr : std::get_if<std::string>(&unknown->data);
    if (name != nullptr) names.push_back(*name);
  }
  return names;
}

bool is_trimmed(const Scene& scene, const std::string& parameter) {
  const std::vector<std::string> names = trimmed_parameters(scene);
  return std::find(names.begin(), names.end(), parameter) != names.end();
}

}  // namespace eigentrail
