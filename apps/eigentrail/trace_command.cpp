#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "commands.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/projection_file.hpp"
#include "interruption.hpp"
#include "output_choice.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"
#include "trace_summary.hpp"

namespace eigentrail::app {
namespace {

struct TraceArguments : SceneArguments {
  OutputChoice output;
  std::string save_reduced;  ///< file for the matrices of a projected model; empty: none
  bool verbose = false;
  int threads = 0;  ///< 0: one per core
  SaveOptions saving;
};

/// Completes the file of a trace that has ended, and prints the summary.
int finish_trace(const TraceArguments& arguments, const TraceSetup& setup, RecordedTrace& recorded) {
  const std::string& output = arguments.output.path;
  const Findings found = recorded.find();
  recorded.finish(found);
  const TraceResult& result = recorded.result();
  if (!arguments.output.quiet) {
    const DataErrors* errors = found.errors ? &*found.errors : nullptr;
    print_summary({setup, result, found.path, recorded.writer()->mode_names(), found.ranges, errors},
                  arguments.verbose);
    std::printf("wrote %s; next: eigentrail report %s -o %s\n", output.c_str(), output.c_str(),
                std::filesystem::path(output).replace_extension(".html").c_str());
  }
  if (result.status == TraceStatus::completed) return done;
  std::fprintf(stderr, "eigentrail: %s; the points before it are in %s\n", result.message.c_str(),
               output.c_str());
  return numbers_failed;
}

/// Runs a trace to its end, from the start or from what is saved. If the file cannot be written, throws an
/// error that says how many points are saved.
int trace_to_file(const TraceArguments& arguments, const TraceSetup& setup,
                  const std::optional<SavedTrace>& saved) {
  const TraceOptions& options = setup.options;
  const std::string& output = arguments.output.path;
  ProgressBar progress(arguments.output.quiet);
  Interruption interruption;
  int saved_points = 0;
  const auto goes_on = [&](const Checkpoint& checkpoint, int points) {
    progress.update((checkpoint.so_far().reached - options.from) / (options.to - options.from), points);
    if (!interruption) return true;
    interruption.save_in_peace();
    return false;
  };
  const auto note_save = [&](int points) {
    saved_points = points;
    Interruption::has_saved();
  };
  try {
    RecordedTrace recorded(setup, {goes_on, note_save}, output, arguments.saving);
    const TraceResult& result = saved ? recorded.resume(*saved) : recorded.begin();
    if (!has_started(result.status)) throw InputError(setup.scene.path + ": " + result.message);
    interruption.save_in_peace();
    progress.finish();
    if (result.status != TraceStatus::stopped) return finish_trace(arguments, setup, recorded);
    std::fprintf(stderr,
                 "eigentrail: interrupted at %s = %s; %d points are in %s; the same command with --resume "
                 "goes on\n",
                 options.parameter.c_str(), exact_text(result.reached).c_str(), result.nodes, output.c_str());
    return interruption.exit_code();
  } catch (const WriteError& error) {
    progress.finish();
    std::string message = output + ": cannot be written on: " + error.what() + "; ";
    message += saved_points > 0 ? std::to_string(saved_points) + " points are in " + output +
                                      "; make room, then the same command with --resume goes on"
                                : "nothing was saved";
    throw std::runtime_error(message);
  }
}

void save_reduced(const TraceArguments& arguments, const TraceSetup& setup) {
  const auto* family = dynamic_cast<const ProjectedFamily*>(setup.model.get());
  if (family == nullptr)
    throw InputError(
        "--save-reduced: it is for sparse families of which some modes are followed; other models have no "
        "projected matrices with the same factors");
  const std::string scene =
      write_projected(arguments.save_reduced, setup.scene, *family, arguments.output.force);
  if (!arguments.output.quiet)
    std::printf("wrote %s and its scene %s\n", arguments.save_reduced.c_str(), scene.c_str());
}

int run_trace(TraceArguments& arguments, const SparseSolverMaker& solver) {
  arguments.output.name_like(arguments.scene, ".h5");
  arguments.saving.existing = arguments.output.existing();
  if (std::isnan(arguments.saving.interval))
    throw InputError("--save-every: expected a number of seconds, found nan");
  TraceSetup setup = given_setup(arguments);
  project_if_large(setup.model, setup.options, {}, {.solver = solver});
  if (!arguments.save_reduced.empty()) save_reduced(arguments, setup);
  setup.options.threads = static_cast<int>(Threads(arguments.threads).size());
  check_parameter_name(setup.scene, setup.options.parameter);
  const std::string& output = arguments.output.path;
  const bool goes_on = arguments.output.resume && std::filesystem::exists(output);
  check_output(output, arguments.output.force || goes_on, hdf5_format(loci_format, "loci file"));
  std::optional<SavedTrace> saved;
  if (goes_on) {
    saved = read_saved_trace(output, setup.scene, setup.options);
    if (!saved) {
      if (!arguments.output.quiet) std::printf("%s: the trace has come to its end already\n", output.c_str());
      return done;
    }
    if (!saved->other_kernel.empty())
      warn(output + ": was computed with another kernel of BLAS (" + saved->other_kernel +
           "); the last digits differ from those of a trace on one machine");
  }
  return trace_to_file(arguments, setup, saved);
}

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<TraceArguments>(program, exit_code, factoring(run_trace), "trace",
                                  "follow the eigenvalues of a scene and write a loci file");
  add_scene(*command, *arguments);
  add_output(*command, arguments->output, "loci file to write (HDF5); default: SCENE.h5, here");
  CLI::Option* quiet =
      add_output_flags(*command, arguments->output,
                       {.resume = "go on with an output that was interrupted; begin where there is none"});
  command
      ->add_option("--save-every", arguments->saving.interval,
                   "seconds of work that may be lost when the program is killed")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_no_lock(*command, arguments->saving);
  command->add_option("--save-reduced", arguments->save_reduced,
                      "large models: write the projected matrices as a family of their own (HDF5; the scene "
                      "that names them is written beside it)");
  command->add_flag("--verbose", arguments->verbose, "the summary with all figures of the work")
      ->excludes(quiet);
  add_trace_options(*command, *arguments);
  command
      ->add_option("--threads", arguments->threads,
                   "threads that share the modes of a point; 0: one per core (results are the same)")
      ->check(CLI::Range(0, 1024));
  command->footer(
      "Examples:\n"
      "  eigentrail trace data/scenes/rotating_mass.toml -o blade.h5\n"
      "  eigentrail trace scene.toml -o out.h5 --from 100 --to 5 --tolerance 1e-8 --modes 4\n"
      "  eigentrail trace scene.toml -o out.h5 --resume\n\n"
      "SIGINT and SIGTERM finish the point and save; the exit code is then 130 or 143. If the point takes "
      "more\n"
      "than a second, the program ends with the points up to the last save.");
}

}  // namespace eigentrail::app
