#include <cstdio>
#include <filesystem>

#include "array_files.hpp"
#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "output.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct LinearizeArguments : SceneArguments {
  std::vector<std::string> at, inputs;
  OutputChoice output;
};

void write(const std::vector<ArrayFile>& files, const OutputChoice& output) {
  if (files.size() > 1) {
    std::error_code error;
    std::filesystem::create_directories(output.path, error);
    if (error) throw InputError(output.path + ": cannot be created: " + error.message());
  }
  std::vector<NewFile> bytes;
  for (const ArrayFile& file : files) {
    check_new_output(file.path, output.force, file.format);
    bytes.push_back({file.path, {file.bytes}});
  }
  write_durably(bytes, output.existing());
}

void print_summary(const TraceSetup& setup, const std::vector<LinearModel>& models,
                   const std::vector<NamedSamples>& arrays, const std::string& path) {
  print_title(setup.scene.title);
  const LinearModel& first = models.front();
  std::printf("%td coordinates, %td constraints, %td freedoms, %td states, at %zu value%s of %s\n",
              first.x.size(), first.A.rows(), first.T.cols(), first.E.rows(), models.size(),
              models.size() == 1 ? "" : "s", setup.options.parameter.c_str());
  std::printf("wrote %s: %s\n", path.c_str(), joined(arrays, ", ", &NamedSamples::name).c_str());
}

int run_linearize(LinearizeArguments& arguments) {
  arguments.output.name_like(arguments.scene, "_linear", ".npz");
  const TraceSetup setup = given_setup(arguments, Purpose::operating_point);
  const std::vector<double> values = given_values(setup, arguments.at);
  check_array_output(arguments.output.path, values.size());
  for (std::string& input : arguments.inputs) input = trimmed(input);
  const LinearModels models = linear_models(setup, values, arguments.inputs);
  for (const auto& [p, fault] : models.faults)
    std::fprintf(stderr, "eigentrail: %s = %s: %s\n", setup.options.parameter.c_str(), exact_text(p).c_str(),
                 printable(fault).c_str());
  for (const std::string& note : models.notes) warn(note);
  if (models.found.empty()) return numbers_failed;
  const std::vector<NamedSamples> arrays = arrays_of(setup, models.found, arguments.inputs);
  write(array_files(arguments.output.path, arrays), arguments.output);
  if (!arguments.output.quiet) print_summary(setup, models.found, arrays, arguments.output.path);
  return models.faults.empty() ? done : numbers_failed;
}

}  // namespace

void add_linearize(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<LinearizeArguments>(
      program, exit_code, run_linearize, "linearize",
      "mass, damping and stiffness matrices at single values, for other programs");
  add_scene(*command, *arguments);
  command->add_option(
      "--at", arguments->at,
      "parameter values, as for spectrum; default: the value of --set, or where the trace begins");
  command
      ->add_option("--inputs", arguments->inputs,
                   "parameters that forces of the scene contain: changes of their values are inputs")
      ->delimiter(',');
  add_output(*command, arguments->output,
             "file that ends in .npz, .mat or .json, or a folder for files of Matrix Market; default: "
             "SCENE_linear.npz, here");
  add_overrides(*command, *arguments, {"parameter", "without"});
  add_output_flags(*command, arguments->output, {"replace an existing output", "", "say nothing"});
  command->footer(
      "Examples:\n"
      "  eigentrail linearize data/scenes/hinged_blade.toml --at 20 40 -o blade.npz\n"
      "  eigentrail linearize data/scenes/double_pendulum.toml -o pendulum.mat");
}

}  // namespace eigentrail::app
