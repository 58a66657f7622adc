#include "scene_arguments.hpp"

#include <cstdio>
#include <filesystem>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/settings.hpp"

namespace eigentrail::app {

void warn(const std::string& message) {
  std::fprintf(stderr, "eigentrail: warning: %s\n", printable(message).c_str());
}

void add_settings(CLI::App& command, SceneArguments& arguments) {
  command
      .add_option(
          "--set", arguments.settings,
          "NAME=VALUE: another value of a parameter of the scene, as a number, a number with a unit, or an "
          "expression; may be repeated")
      ->allow_extra_args(false);
}

void add_scene(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "scene file (TOML)")->required();
  add_settings(command, arguments);
}

Scene given_scene(const SceneArguments& arguments) {
  return with_settings_of(arguments, read_scene(arguments.scene));
}

Scene with_settings_of(const SceneArguments& arguments, Scene scene) {
  ChangedScene changed = with_settings(std::move(scene), arguments.settings);
  for (const std::string& warning : changed.warnings) warn(warning);
  return std::move(changed.scene);
}

void warn_of_unused(const Scene& scene, const Model& model) {
  for (const int parameter : model.description().unused_parameters)
    warn(unused_error(scene, parameter).what());
}

std::string beside(const std::string& scene, const std::string& ending) {
  return std::filesystem::path(scene).stem().string() + ending;
}

}  // namespace eigentrail::app
