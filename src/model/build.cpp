#include "eigentrail/model/build.hpp"

#include <algorithm>

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

bool is_matrix_family(const Scene& scene) {
  return scene.root.find("matrix_family") != nullptr;
}

std::unique_ptr<Model> build_model(const Scene& scene, const std::vector<Vector>& check_at,
                                   const std::set<int>& used_elsewhere) {
  check_top_level(scene);
  return is_matrix_family(scene) ? read_matrix_family(scene, used_elsewhere)
                                 : read_multibody(scene, check_at, used_elsewhere);
}

}  // namespace eigentrail
