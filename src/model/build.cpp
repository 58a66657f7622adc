#include "eigentrail/model/build.hpp"

#include <algorithm>

#include "eigentrail/core/text.hpp"
#include "model/draft.hpp"
#include "model/matrix_family.hpp"
#include "model/read_multibody.hpp"
#include "model/sampled_family.hpp"

namespace eigentrail {
namespace {

/// Checks that the entries of the matrices that depend on parameters are finite at the points to be checked.
void check_entries(const Scene& scene, const ModelRequest& request) {
  Draft draft(scene, request);
  TableReader table = draft.reader(*tables(scene, "matrix_family").front(), "[matrix_family]");
  for (const char* key : {"M", "C", "K", "A"}) {
    if (!table.has(key)) continue;
    for (const auto& matrix : table.matrices(key)) {
      for (const auto& row : matrix) {
        for (const Expression& entry : row) {
          if (!entry.is_constant()) draft.check_range(table, key, entry, Range::any);
        }
      }
    }
  }
}

}  // namespace

void check_top_level(const Scene& scene) {
  std::vector<std::string> known = {"title",  "parameters",    "trace",
                                    "events", "matrix_family", "sampled_family"};
  const char* family = scene.root.find("matrix_family") != nullptr ? "matrix_family" : "sampled_family";
  if (!is_matrix_family(scene)) {
    for (const EffectHelp& effect : effect_reference()) known.push_back(effect.name);
  } else {
    std::erase_if(known,
                  [family](const std::string& key) { return key.ends_with("_family") && key != family; });
  }
  for (const auto& [key, value] : scene.root.entries) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string kind = is_matrix_family(scene) ? " in a scene with [" + std::string(family) + "]" : "";
    throw scene_error(scene, value.where, key + ": unknown key" + kind + "; " + suggestion(key, known));
  }
}

std::string strength_parameter(const std::string& effect) {
  return "strength of " + effect;
}

bool is_matrix_family(const Scene& scene) {
  return scene.root.find("matrix_family") != nullptr || scene.root.find("sampled_family") != nullptr;
}

std::unique_ptr<Model> build_model(const Scene& scene, const ModelRequest& request) {
  check_top_level(scene);
  if (!is_matrix_family(scene)) return read_multibody(scene, request);
  if (!request.without.empty()) {
    throw without_error(scene, request.without.front(),
                        "cannot be left out: a family of matrices has no effects");
  }
  if (scene.root.find("sampled_family") != nullptr)
    return read_sampled_family(scene, request.used_elsewhere, request.check_at);
  std::unique_ptr<Model> model = read_matrix_family(scene, request.used_elsewhere);
  check_entries(scene, request);
  return model;
}

InputError without_error(const Scene& scene, const std::string& effect, const std::string& message) {
  SourceLocation where;
  for (const Table* trace : tables(scene, "trace")) {
    const Value* without = trace->find("without");
    const auto* names = without == nullptr ? nullptr : std::get_if<std::string>(&without->data);
    if (names != nullptr && names->find(effect) != std::string::npos) where = without->where;
  }
  return scene_error(scene, where, "[trace] without: '" + effect + "' " + message);
}

}  // namespace eigentrail
