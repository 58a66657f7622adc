#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/accuracy/findings.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/build.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/projection_file.hpp"
#include "factor_team.hpp"
#include "interruption.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"
#include "trace_flags.hpp"
#include "trace_summary.hpp"

namespace eigentrail::app {
namespace {

struct TraceArguments : SceneArguments {
  std::string output;
  bool force = false;
  bool resume = false;
  bool quiet = false;
  std::string save_reduced;  ///< file for the matrices of a projected model; empty: none
  bool verbose = false;
  int threads = 0;  ///< 0: one per core
  SaveOptions saving;
  std::map<std::string, std::string> options;  ///< overrides of the scene's [trace]
};

/// A trace and its loci file, from the start or resumed.
class TraceRun {
 public:
  TraceRun(const TraceArguments& arguments, TraceSetup setup)
      : arguments_(arguments), setup_(std::move(setup)), progress_(arguments.quiet) {}

  int begin() {
    return guarded([&] {
      result_ = trace(*setup_.model, setup_.options, observer());
      if (!has_started(result_.status)) throw InputError(setup_.scene.path + ": " + result_.message);
    });
  }

  int resume(const SavedTrace& saved) {
    recorder_ = PathRecorder(saved.path);
    writer_.emplace(arguments_.output, *setup_.model, setup_.options, saved, arguments_.saving);
    note_save();
    if (!saved.other_kernel.empty())
      warn(arguments_.output + ": was computed with another kernel of BLAS (" + saved.other_kernel +
           "); the last digits differ from those of a trace on one machine");
    return guarded([&] { result_ = resume_trace(*setup_.model, setup_.options, observer(), saved.trace); });
  }

 private:
  /// Runs the trace to its end. If the file cannot be written, throws an error that says how many points are
  /// saved.
  template <class Run>
  int guarded(Run&& run) {
    try {
      run();
      return end();
    } catch (const WriteError& error) {
      progress_.finish();
      const std::string& output = arguments_.output;
      std::string message = output + ": cannot be written on: " + error.what() + "; ";
      message += saved_points_ > 0 ? std::to_string(saved_points_) + " points are in " + output +
                                         "; make room, then the same command with --resume goes on"
                                   : "nothing was saved";
      throw std::runtime_error(message);
    }
  }

  TraceObserver observer() {
    TraceObserver observer;
    observer.started = [this](const TraceStart& start) { started_ = start; };
    observer.point = [this](const TracePoint& point) {
      if (!writer_) {
        writer_.emplace(arguments_.output, setup_.scene, *setup_.model, setup_.options, started_, point,
                        arguments_.saving);
      }
      writer_->append(point);
      recorder_.append(point);
      const TraceOptions& options = setup_.options;
      progress_.update((point.node.p - options.from) / (options.to - options.from), recorder_.points());
      return true;
    };
    observer.checkpoint = [this](const Checkpoint& checkpoint) {
      if (!interruption_) {
        if (writer_->checkpoint(checkpoint)) note_save();
        return true;
      }
      interruption_.save_in_peace();
      writer_->interrupt(checkpoint);
      interrupted_ = true;
      note_save();
      return false;
    };
    return observer;
  }

  void note_save() {
    saved_points_ = recorder_.points();
    Interruption::has_saved();
  }

  int end() {
    interruption_.save_in_peace();
    progress_.finish();
    const std::string& output = arguments_.output;
    if (interrupted_) {
      std::fprintf(stderr,
                   "eigentrail: interrupted at %s = %s; %d points are in %s; the same command with --resume "
                   "goes on\n",
                   setup_.options.parameter.c_str(), exact_text(result_.reached).c_str(), result_.nodes,
                   output.c_str());
      return interruption_.exit_code();
    }
    const Findings found = find_ranges_and_errors(*setup_.model, setup_.options, recorder_.path(), result_);
    const DataErrors* errors = found.errors ? &*found.errors : nullptr;
    writer_->finish(result_, found.ranges, errors);
    if (!arguments_.quiet) {
      print_summary({setup_, result_, found.path, writer_->mode_names(), found.ranges, errors},
                    arguments_.verbose);
      std::printf("wrote %s; next: eigentrail report %s -o %s\n", output.c_str(), output.c_str(),
                  std::filesystem::path(output).replace_extension(".html").c_str());
    }
    if (result_.status == TraceStatus::completed) return done;
    std::fprintf(stderr, "eigentrail: %s; the points before it are in %s\n", result_.message.c_str(),
                 output.c_str());
    return numbers_failed;
  }

  const TraceArguments& arguments_;
  TraceSetup setup_;
  ProgressBar progress_;
  Interruption interruption_;
  bool interrupted_ = false;
  int saved_points_ = 0;  ///< number of points in the saved file
  TraceStart started_;
  std::optional<LociWriter> writer_;
  PathRecorder recorder_;
  TraceResult result_;
};

void save_reduced(const TraceArguments& arguments, const TraceSetup& setup) {
  const auto* family = dynamic_cast<const ProjectedFamily*>(setup.model.get());
  if (family == nullptr)
    throw InputError(
        "--save-reduced: it is for sparse families of which some modes are followed; other models have no "
        "projected matrices with the same factors");
  const std::string scene = write_projected(arguments.save_reduced, setup.scene, *family, arguments.force);
  if (!arguments.quiet)
    std::printf("wrote %s and its scene %s\n", arguments.save_reduced.c_str(), scene.c_str());
}

int run_trace(const TraceArguments& arguments, const SparseSolverMaker& solver) {
  if (std::isnan(arguments.saving.interval))
    throw InputError("--save-every: expected a number of seconds, found nan");
  TraceSetup setup =
      prepare_trace(given_scene(arguments), {arguments.options.begin(), arguments.options.end()});
  warn_of_unused(setup.scene, *setup.model);
  project_if_large(setup.model, setup.options, {}, {.solver = solver});
  if (!arguments.save_reduced.empty()) save_reduced(arguments, setup);
  setup.options.threads = arguments.threads > 0
                              ? arguments.threads
                              : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  check_parameter_name(setup.scene, setup.options.parameter);
  const std::string& output = arguments.output;
  const bool goes_on = arguments.resume && std::filesystem::exists(output);
  check_output(output, arguments.force || goes_on, {loci_format, "loci file"});
  if (!goes_on) return TraceRun(arguments, std::move(setup)).begin();
  const auto saved = read_saved_trace(output, setup.scene, setup.options);
  if (saved) return TraceRun(arguments, std::move(setup)).resume(*saved);
  if (!arguments.quiet) std::printf("%s: the trace has come to its end already\n", output.c_str());
  return done;
}

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<TraceArguments>();
  CLI::App* command =
      program.add_subcommand("trace", "follow the eigenvalues of a scene and write a loci file");
  add_scene(*command, *arguments);
  auto* output = command->add_option("-o,--output", arguments->output,
                                     "loci file to write (HDF5); default: SCENE.h5, here");
  const auto force = command->add_flag("--force", arguments->force, "replace an existing output");
  command
      ->add_flag("--resume", arguments->resume,
                 "go on with an output that was interrupted; begin where there is none")
      ->excludes(force);
  command
      ->add_option("--save-every", arguments->saving.interval,
                   "seconds of work that may be lost when the program is killed")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_no_lock(*command, arguments->saving);
  command->add_option("--save-reduced", arguments->save_reduced,
                      "large models: write the projected matrices as a family of their own (HDF5; the scene "
                      "that names them is written beside it)");
  auto* quiet = command->add_flag("-q,--quiet", arguments->quiet, "no progress bar, no summary");
  command->add_flag("--verbose", arguments->verbose, "the summary with all figures of the work")
      ->excludes(quiet);
  add_trace_options(*command, arguments->options);
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
  command->callback([arguments, output, &exit_code] {
    if (output->count() == 0) arguments->output = beside(arguments->scene, ".h5");
    arguments->saving.existing = existing(arguments->force);
    exit_code =
        factoring_together([&](const SparseSolverMaker& solver) { return run_trace(*arguments, solver); });
  });
}

}  // namespace eigentrail::app
