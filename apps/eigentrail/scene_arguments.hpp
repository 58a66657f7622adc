// What the commands that take a scene have in common: the file, --set, options of traces, and warnings.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail::app {

struct SceneArguments {
  std::string scene;
  std::vector<std::string> settings;           ///< NAME=VALUE
  std::map<std::string, std::string> options;  ///< overrides of the scene's [trace]

  OptionTexts overrides() const { return {options.begin(), options.end()}; }
  /// The traced parameter: that of the options, else the scene's.
  std::string traced(const Scene& of) const;
};

/// Of commands over a window of the traced parameter and a second one.
struct PlaneArguments : SceneArguments {
  std::string second;
  std::optional<std::string> second_from, second_to;
  std::map<std::string, std::string>
      first;  ///< "from" and "to" by their former names, --first-from, --first-to

  /// The numbers of the second range, whose texts may have units. Takes --from and --to for that range, with
  /// a warning, where it is not given otherwise: so they were named. Throws InputError.
  std::pair<double, double> second_range(const Scene& of);
};

/// Adds an option, which is returned; its text goes to `texts`, if it is given.
CLI::Option* add_text(CLI::App& command, const std::string& flag, std::map<std::string, std::string>& texts,
                      const std::string& key, const std::string& help);

/// Adds SCENE and --set to a command.
void add_scene(CLI::App& command, SceneArguments& arguments);
/// Adds --set alone.
void add_settings(CLI::App& command, SceneArguments& arguments);

/// Adds an option of traces: "max_step" is --max-step, if it has no other `flag`.
void add_override(CLI::App& command, SceneArguments& arguments, const std::string& key,
                  const std::string& help, std::string flag = "");
/// Adds options that are as for trace.
void add_overrides(CLI::App& command, SceneArguments& arguments, const std::vector<std::string>& keys);
void add_no_certify(CLI::App& command, SceneArguments& arguments, const std::string& help);
/// Adds all options of traces.
void add_trace_options(CLI::App& command, SceneArguments& arguments);

/// Adds --second with its range, and --from and --to.
void add_plane(CLI::App& command, PlaneArguments& arguments);

/// Adds --no-lock.
void add_no_lock(CLI::App& command, SaveOptions& saving);

/// Reads the scene and sets its parameters. Prints warnings about settings without effect.
Scene given_scene(const SceneArguments& arguments);

/// Prepares a scene, or the given one, with its parameters set and its options overridden. Prints warnings
/// about what has no effect.
TraceSetup given_setup(const SceneArguments& arguments, Purpose purpose = Purpose::trace);
TraceSetup given_setup(const SceneArguments& arguments, Scene scene, Purpose purpose);

/// The values of --at, in the unit of the traced parameter; without texts, where the trace begins.
std::vector<double> given_values(const TraceSetup& setup, const std::vector<std::string>& at);

/// Prints a warning on stderr.
void warn(const std::string& message);

/// Prints a warning, on stderr, for each parameter on which nothing in the scene depends.
void warn_of_unused(const Scene& scene, const Model& model);

}  // namespace eigentrail::app
