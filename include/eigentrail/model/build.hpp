// Builds a model from a scene.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail {

/// Options for building a model from a scene.
struct ModelRequest {
  /// Parameter values (declared units) at which masses, lengths and the direction of gravity are checked:
  /// points of the trace, its beginning and end first.
  std::vector<Vector> check_at;
  std::set<int> used_elsewhere = {};      ///< parameters that need not occur in the model
  std::vector<std::string> without = {};  ///< effects of the scene that are switched off
  /// Whether to add a parameter strength_parameter(name) for every effect of the scene except constraints.
  /// Its value is one and it multiplies the forces of the effect: sensitivities to it show the influence of
  /// the effect.
  bool strengths = false;
};

/// Builds the model that a scene describes: a multibody system, a rotor if the scene has [[shaft]], or a
/// family of matrices if it has [matrix_family] or [sampled_family]. Throws InputError for every fault of the
/// scene, including unknown keys and misspelt parameters.
std::unique_ptr<Model> build_model(const Scene& scene, const ModelRequest& request);

/// Name of the parameter that multiplies the forces of an effect; no parameter of a scene can have this name.
std::string strength_parameter(const std::string& effect);

/// Throws InputError for an unknown top-level key and names the nearest known one. To be called before
/// anything else is read, so that a misspelt table is not reported as missing.
void check_top_level(const Scene& scene);

/// The error for an effect that cannot be switched off, with the position where the scene names it; without a
/// position if only the command line names it.
InputError without_error(const Scene& scene, const std::string& effect, const std::string& message);

/// Whether the scene has [matrix_family] or [sampled_family], that is, matrices instead of elements.
bool is_matrix_family(const Scene& scene);

/// Whether the scene has [[shaft]]: then it is a rotor, a family of matrices made of shafts, discs and
/// bearings.
bool is_rotor(const Scene& scene);

/// Describes one key of the tables of an effect, for help and documentation.
struct FieldHelp {
  std::string key;
  std::string unit;  ///< unit, or kind of value
  std::string help;
  std::string otherwise = {};  ///< default value as text; empty: the key is required
};
struct EffectHelp {
  std::string name;
  std::string description;
  std::vector<FieldHelp> fields;
  std::vector<FieldHelp> states = {};  ///< unknowns of its own, of first order: name, unit and meaning
};

/// All effects of multibody scenes, in the order of evaluation.
std::vector<EffectHelp> effect_reference();

/// The tables of a rotor. Its [[bearing]] has the name of an effect, and other keys.
std::vector<EffectHelp> rotor_reference();

}  // namespace eigentrail
