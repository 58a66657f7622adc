#include "scene_arguments.hpp"

#include <algorithm>
#include <cstdio>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/settings.hpp"

namespace eigentrail::app {
namespace {

Scene with_settings_of(const SceneArguments& arguments, Scene scene) {
  ChangedScene changed = with_settings(std::move(scene), arguments.settings);
  for (const std::string& warning : changed.warnings) warn(warning);
  return std::move(changed.scene);
}

}  // namespace

void warn(const std::string& message) {
  std::fprintf(stderr, "eigentrail: warning: %s\n", printable(message).c_str());
}

CLI::Option* add_text(CLI::App& command, const std::string& flag, std::map<std::string, std::string>& texts,
                      const std::string& key, const std::string& help) {
  return command.add_option_function<std::string>(
      flag, [&texts, key](const std::string& text) { texts[key] = text; }, help);
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

void add_override(CLI::App& command, SceneArguments& arguments, const std::string& key,
                  const std::string& help, std::string flag) {
  if (flag.empty()) {
    flag = "--" + key;
    std::replace(flag.begin(), flag.end(), '_', '-');
  }
  add_text(command, flag, arguments.options, key, help + " (overrides the scene)");
}

void add_overrides(CLI::App& command, SceneArguments& arguments, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) add_override(command, arguments, key, "as for trace");
}

void add_no_certify(CLI::App& command, SceneArguments& arguments, const std::string& help) {
  command.add_flag_callback(
      "--no-certify", [&arguments] { arguments.options["certify"] = "false"; }, help);
}

void add_trace_options(CLI::App& command, SceneArguments& arguments) {
  const TraceOptions defaults;
  TraceOptions::fields(defaults, [&](const std::string& key, const char* help, const auto&) {
    if (key != "certify") add_override(command, arguments, key, help);
  });
  add_no_certify(
      command, arguments,
      "no certificate at every step that no modes were exchanged: faster, and compares shapes only");
}

void add_no_lock(CLI::App& command, SaveOptions& saving) {
  command.add_flag_callback(
      "--no-lock", [&saving] { saving.lock = false; },
      "write without a lock against other processes, on file systems that offer none");
}

Scene given_scene(const SceneArguments& arguments) {
  return with_settings_of(arguments, read_scene(arguments.scene));
}

TraceSetup given_setup(const SceneArguments& arguments, Scene scene, Purpose purpose) {
  TraceSetup setup =
      prepare_trace(with_settings_of(arguments, std::move(scene)), arguments.overrides(), purpose);
  warn_of_unused(setup.scene, *setup.model);
  return setup;
}

TraceSetup given_setup(const SceneArguments& arguments, Purpose purpose) {
  return given_setup(arguments, read_scene(arguments.scene), purpose);
}

void warn_of_unused(const Scene& scene, const Model& model) {
  for (const int parameter : model.description().unused_parameters)
    warn(unused_error(scene, parameter).what());
}

}  // namespace eigentrail::app
