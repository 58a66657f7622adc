#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "output_choice.hpp"
#include "starters.hpp"

namespace eigentrail::app {
namespace {

struct NewArguments {
  std::string output;
  std::string starter = "blade";
};

int run_new(const NewArguments& arguments) {
  const auto* const starter = std::ranges::find(starters, arguments.starter, &Starter::name);
  if (starter == std::end(starters)) {
    std::vector<std::string> names;
    for (const Starter& known : starters) names.emplace_back(known.name);
    throw InputError("--starter: there is none called '" + arguments.starter + "'; " +
                     suggestion(arguments.starter, names));
  }
  const std::string& path = arguments.output;
  std::error_code error;
  if (std::filesystem::exists(path, error))
    throw InputError(path + ": exists already, and a scene is never replaced; give another name");
  check_new_output(path, false, {"scene", [](const std::string&) { return false; }});
  // The commands in the comments of a starter name its file.
  write_durably(path, {replaced_all(std::string(starter->text), "@file@", path)});
  std::printf("wrote %s; next: eigentrail explain %s\n", path.c_str(), path.c_str());
  return done;
}

}  // namespace

void add_new(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<NewArguments>(program, exit_code, run_new, "new", "write a commented scene to start from");
  command->add_option("SCENE", arguments->output, "scene file to write (TOML)")->required();
  command
      ->add_option("--starter", arguments->starter,
                   "blade: bodies, hinges and a rotating frame; pendulum: a point on a rod; rotor: a shaft "
                   "with discs in bearings; matrices: M, C, K")
      ->capture_default_str();
  command->footer("Examples:\n  eigentrail new blade.toml\n  eigentrail new flutter.toml --starter matrices");
}

}  // namespace eigentrail::app
