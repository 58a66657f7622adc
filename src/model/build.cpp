#include "eigentrail/model/build.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"
#include "model/matrix_family.hpp"
#include "model/read_multibody.hpp"

namespace eigentrail {

void check_top_level(const Scene& scene) {
  std::vector<std::string> known = {"title", "parameters", "trace", "events", "matrix_family"};
  if (!is_matrix_family(scene)) {
    for (const EffectHelp& effect : effect_reference()) known.push_back(effect.name);
  }
  for (const auto& [key, value] : scene.root.entries) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string kind = is_matrix_family(scene) ? " in a scene with [matrix_family]" : "";
    throw scene_error(scene, value.where, key + ": unknown key" + kind + "; " + suggestion(key, known));
  }
}

std::string strength_parameter(const std::string& effect) {
  return "strength of " + effect;
}

bool is_matrix_family(const Scene& scene) {
  return scene.root.find("matrix_family") != nullptr;
}

std::unique_ptr<Model> build_model(const Scene& scene, const ModelRequest& request) {
  check_top_level(scene);
  if (!is_matrix_family(scene)) return read_multibody(scene, request);
  if (!request.without.empty()) {
    throw InputError(scene.path + ": '" + printable(request.without.front()) +
                     "' cannot be left out: a family of matrices has no effects");
  }
  return read_matrix_family(scene, request.used_elsewhere);
}

}  // namespace eigentrail
