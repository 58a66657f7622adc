#include "eigentrail/model/build.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/blas.hpp"
#include "model/model_readers.hpp"

namespace eigentrail {
void check_top_level(const Scene& scene) {
  std::vector<std::string> known = {"title", "parameters", "trace", "events", "modes"};
  std::string family;
  for (const char* name : {"shaft", "sampled_family", "matrix_family"}) {
    if (scene.root.find(name) != nullptr) family = name;
  }
  if (family.empty()) {
    known.insert(known.end(), {"matrix_family", "sampled_family", "reactions"});
    for (const EffectHelp& effect : effect_reference()) known.push_back(effect.name);
  } else if (family != "shaft") {
    known.push_back(family);
  }
  if (family.empty() || family == "shaft") {
    for (const std::string& name : rotor_tables()) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    }
  }
  if (!family.empty()) known.push_back("trim");  // is refused with the reason
  const std::string heading = family == "shaft" ? "[[shaft]]" : "[" + family + "]";
  for (const auto& [key, value] : scene.root.entries) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string kind = family.empty() ? "" : " in a scene with " + heading;
    const std::string meant = nearest_name(key, known);
    throw scene_error(scene, value.where,
                      key + ": unknown key" + kind + ", not supported; " +
                          (meant.empty() ? "" : "did you mean '" + meant + "'? ") +
                          "all tables: docs/scene-tables.md, or eigentrail reference");
  }
  for (const char* name : {"disc", "support"}) {
    const Value* value = scene.root.find(name);
    if (value != nullptr && !is_rotor(scene))
      throw scene_error(scene, value->where,
                        std::string("[[") + name + "]]: belongs to a [[shaft]], and the scene has none");
  }
}

std::string strength_parameter(const std::string& effect) {
  return "strength of " + effect;
}

bool is_matrix_family(const Scene& scene) {
  return scene.root.find("matrix_family") != nullptr || scene.root.find("sampled_family") != nullptr;
}

bool is_rotor(const Scene& scene) {
  return scene.root.find("shaft") != nullptr;
}

std::unique_ptr<Model> build_model(const Scene& scene, const ModelRequest& request) {
  check_top_level(scene);
  if (!blas_has_memory_for(1))
    throw std::runtime_error(
        "not enough memory to compute: BLAS takes 128 MB at a time; allow more (ulimit -v)");
  if (!tables(scene, "trim").empty() && (is_matrix_family(scene) || is_rotor(scene)))
    throw scene_error(scene, tables(scene, "trim").front()->where,
                      "[[trim]]: not in a family of matrices or a scene with [[shaft]], which have no "
                      "equilibrium to trim");
  if (!is_matrix_family(scene) && !is_rotor(scene)) return read_multibody(scene, request);
  if (is_rotor(scene)) return read_rotor(scene, request);
  if (!request.without.empty())
    throw without_error(scene, request.without.front(),
                        "cannot be left out: a family of matrices has no effects");
  return scene.root.find("sampled_family") != nullptr ? read_sampled_family(scene, request)
                                                      : read_matrix_family(scene, request);
}

InputError without_error(const Scene& scene, const std::string& effect, const std::string& message) {
  SourceLocation where;
  for (const Table* trace : tables(scene, "trace")) {
    const Value* without = trace->find("without");
    const auto* names = without == nullptr ? nullptr : std::get_if<std::string>(&without->data);
    if (names != nullptr && names->find(effect) != std::string::npos) where = without->where;
  }
  const std::string text = "without: '" + effect + "' " + message;
  return where == SourceLocation{} ? InputError("--" + text) : scene_error(scene, where, "[trace] " + text);
}

}  // namespace eigentrail
