// From a scene to a model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// What a model is asked for besides the scene.
struct ModelRequest {
  /// Parameter values (declared units) at which masses, lengths and the direction of gravity are checked:
  /// points of the trace, its beginning and its end first.
  std::vector<Vector> check_at;
  std::set<int> used_elsewhere = {};      ///< parameters that need no use in the model
  std::vector<std::string> without = {};  ///< effects of the scene that are switched off
  /// Adds a parameter for every effect of the scene that is no constraint, strength_parameter(name), which is
  /// one and multiplies its forces: sensitivities to it tell what the effect does.
  bool strengths = false;
};

/// Builds the model that a scene describes: a multibody system, or a family of matrices when the scene has
/// [matrix_family]. Throws InputError for every fault of the scene, unknown keys and unused parameters
/// included.
std::unique_ptr<Model> build_model(const Scene& scene, const ModelRequest& request);

/// Name of the parameter that multiplies an effect; no scene can use it.
std::string strength_parameter(const std::string& effect);

/// Rejects top-level keys that no scene has, naming the nearest known one. Done before anything else is read,
/// so that a misspelt table is not reported as a missing one.
void check_top_level(const Scene& scene);

/// An effect that cannot be left out, with the place where the scene names it; the command line may, too.
InputError without_error(const Scene& scene, const std::string& effect, const std::string& message);

/// Whether the scene gives matrices instead of elements.
bool is_matrix_family(const Scene& scene);

/// One line per key that a table of the given effect takes, for help and documentation.
struct FieldHelp {
  std::string key;
  std::string unit;  ///< or what kind of value it is
  std::string help;
  std::string otherwise = {};  ///< value when the scene is silent, as text; empty: the key is required
};
struct EffectHelp {
  std::string name;
  std::string description;
  std::vector<FieldHelp> fields;
};

/// Every effect of multibody scenes, in the order of evaluation.
std::vector<EffectHelp> effect_reference();

}  // namespace eigentrail
