#include "scene_arguments.hpp"

#include <algorithm>
#include <cstdio>

#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/settings.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

ChangedScene with_settings_of(const SceneArguments& arguments, Scene scene) {
  ChangedScene changed = with_settings(std::move(scene), arguments.settings);
  for (const std::string& warning : changed.warnings) warn(warning);
  return changed;
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

void add_plane(CLI::App& command, PlaneArguments& arguments) {
  command.add_option("--second", arguments.second, "name of the second parameter")->required();
  command.add_option("--second-from", arguments.second_from, "where its range begins, in its unit");
  command.add_option("--second-to", arguments.second_to, "where its range ends");
  add_override(command, arguments, "from", "where the range of the traced parameter begins, in its unit");
  add_override(command, arguments, "to", "where it ends");
  for (const std::string key : {"from", "to"})
    add_text(command, "--first-" + key, arguments.first, key, "former name of --" + key)->group("");
}

std::string SceneArguments::traced(const Scene& of) const {
  const auto given = options.find("parameter");
  return given == options.end() ? traced_parameter(of) : given->second;
}

std::pair<double, double> PlaneArguments::second_range(const Scene& of) {
  if (!second_from && !second_to && (options.contains("from") || options.contains("to"))) {
    warn(
        "--from and --to are taken for the range of --second, in this version only; write --second-from and "
        "--second-to, and --from and --to for --first-from and --first-to");
    for (const auto& [key, end] : {std::pair("from", &second_from), std::pair("to", &second_to)}) {
      if (const auto given = options.extract(key)) *end = given.mapped();
    }
  }
  for (const auto& [key, text] : first) options[key] = text;
  const Parameter parameter = parameter_called(of, second);
  const auto number = [&](const std::string& option, const std::optional<std::string>& text) {
    if (!text) throw InputError(option + ": is missing; give the range of '" + second + "'");
    return read_value(option, *text, parameter);
  };
  const double begin = number("--second-from", second_from);
  return {begin, number("--second-to", second_to)};
}

void add_no_lock(CLI::App& command, SaveOptions& saving) {
  command.add_flag_callback(
      "--no-lock", [&saving] { saving.lock = false; },
      "write without a lock against other processes, on file systems that offer none");
}

Scene given_scene(const SceneArguments& arguments) {
  return with_settings_of(arguments, read_scene(arguments.scene)).scene;
}

TraceSetup given_setup(const SceneArguments& arguments, Scene scene, Purpose purpose) {
  ChangedScene changed = with_settings_of(arguments, std::move(scene));
  TraceSetup setup = prepare_trace(std::move(changed.scene), arguments.overrides(), purpose);
  const std::string& traced = setup.options.parameter;
  if (std::ranges::find(changed.names, traced) != changed.names.end()) {
    if (purpose == Purpose::operating_point)
      setup.options.from = setup.scene.parameters.declared_values()[setup.traced()];
    else
      warn("--set " + traced + ": has no effect: its values are those of the trace");
  }
  warn_of_unused(setup.scene, *setup.model);
  return setup;
}

TraceSetup given_setup(const SceneArguments& arguments, Purpose purpose) {
  return given_setup(arguments, read_scene(arguments.scene), purpose);
}

std::vector<double> given_values(const TraceSetup& setup, const std::vector<std::string>& at) {
  if (at.empty()) return {setup.options.from};
  return read_values("--at", at, setup.scene.parameters.at(setup.options.parameter));
}

void warn_of_unused(const Scene& scene, const Model& model) {
  for (const int parameter : model.description().unused_parameters)
    warn(unused_error(scene, parameter).what());
}

}  // namespace eigentrail::app
