#include "eigentrail/scene/traced_parameter.hpp"

namespace eigentrail {

std::string traced_parameter(const Scene& scene) {
  for (const Table* trace : tables(scene, "trace")) {
    const Value* value = trace->find("parameter");
    const auto* name = value == nullptr ? nullptr : std::get_if<std::string>(&value->data);
    if (name != nullptr) return *name;
  }
  return "";
}

}  // namespace eigentrail
