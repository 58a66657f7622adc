// What the commands that take a scene have in common: the file, --set, and warnings.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "eigentrail/model/model.hpp"
#include "eigentrail/scene/scene.hpp"

namespace eigentrail::app {

struct SceneArguments {
  std::string scene;
  std::vector<std::string> settings;  ///< NAME=VALUE
};

/// Adds SCENE and --set to a command.
void add_scene(CLI::App& command, SceneArguments& arguments);
/// Adds --set alone.
void add_settings(CLI::App& command, SceneArguments& arguments);

/// Reads the scene and sets its parameters. Prints warnings about settings without effect.
Scene given_scene(const SceneArguments& arguments);
Scene with_settings_of(const SceneArguments& arguments, Scene scene);

/// Prints a warning on stderr.
void warn(const std::string& message);

/// Prints a warning, on stderr, for each parameter on which nothing in the scene depends.
void warn_of_unused(const Scene& scene, const Model& model);

/// The name of an output file that was not given: that of the scene, with another ending, in the folder in
/// which the program runs.
std::string beside(const std::string& scene, const std::string& ending);

}  // namespace eigentrail::app
