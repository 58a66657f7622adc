#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "explain.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct ExplainArguments : SceneArguments {
  bool sensitivity = false;
};

int run_explain(const ExplainArguments& arguments, const SparseSolverMaker& solver) {
  const TraceSetup setup = given_setup(arguments);
  const Route route = explain(stdout, setup, arguments.overrides(), arguments.sensitivity, solver);
  if (!route.is_projected)
    std::printf("next: eigentrail trace %s -o %s\n", setup.scene.path.c_str(),
                std::filesystem::path(setup.scene.path).stem().replace_extension(".h5").c_str());
  return done;
}

}  // namespace

void add_explain(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<ExplainArguments>(program, exit_code, factoring(run_explain), "explain",
                                    "effects, structure, sizes and chosen solvers of a scene");
  add_scene(*command, *arguments);
  command->add_flag("--sensitivity", arguments->sensitivity,
                    "rank the effects by their influence on each mode where the trace begins");
  add_overrides(*command, *arguments, {"parameter", "from", "to", "modes", "order", "without"});
  command->footer(
      "Examples:\n"
      "  eigentrail explain data/scenes/rotating_mass.toml\n"
      "  eigentrail explain data/scenes/rotating_mass.toml --sensitivity --without drag");
}

}  // namespace eigentrail::app
