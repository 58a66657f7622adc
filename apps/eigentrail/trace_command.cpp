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
#include "eigentrail/accuracy/data_errors.hpp"
#include "eigentrail/accuracy/shallow_extrema.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/build.hpp"
#include "eigentrail/stability/undecided_ranges.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/projection_file.hpp"
#include "interruption.hpp"
#include "output.hpp"
#include "projection_info.hpp"
#include "progress_bar.hpp"
#include "ranges.hpp"

namespace eigentrail::app {
namespace {

struct TraceArguments {
  std::string scene;
  std::string output;
  bool force = false;
  bool resume = false;
  bool quiet = false;
  std::string save_reduced;  ///< file for the matrices of a projected model; empty: none
  int threads = 0;  ///< 0: one per core
  double save_every = LociWriter::usual_interval;
  std::map<std::string, std::string> options;  ///< overrides of the scene's [trace]
};

std::string percent(double part, double whole) {
  return whole > 0.0 ? rounded(100.0 * part / whole, 2) + " %" : "0 %";
}

void print_work(const TraceResult& result) {
  const RunCounts& counts = result.counts;
  const double per_mode_and_step =
      static_cast<double>(counts.modes.factorizations) / static_cast<double>(std::max(result.mode_steps, 1L));
  const Rejections& r = result.rejections;
  std::printf("  work  %d points, %d steps tried again", result.nodes, r.total());
  if (r.total() > 0) {
    std::printf(" (%d inaccurate, %d uncertified, %d no equilibrium, %d mode lost, %d mismatch, %d merged)",
                r.inaccurate, r.uncertified, r.no_equilibrium, r.mode_lost, r.mismatch, r.merged);
  }
  const Regroupings& g = result.regroupings;
  if (g.joined + g.charts + g.planes + g.repaired > 0) {
    std::printf(
        "\n        %d blocks of close modes formed, %d taken apart; %d changes between s and 1/s; %d changes "
        "of "
        "the path's coordinate; %d missing modes added",
        g.joined, g.parted, g.charts, g.planes, g.repaired);
  }
  std::printf(
      "\n        %s LU per mode and step, %llu for the certificate, %llu for special points, %llu KINSOL "
      "iterations, %llu KKT "
      "factorizations\n",
      rounded(per_mode_and_step, 3).c_str(),
      static_cast<unsigned long long>(counts.certificate_factorizations),
      static_cast<unsigned long long>(counts.event_factorizations),
      static_cast<unsigned long long>(counts.equilibrium_iterations),
      static_cast<unsigned long long>(counts.equilibrium_factorizations));
  if (counts.modes.modal_bases + counts.certificate_bases > 0) {
    std::printf(
        "        all modes at once: %llu bases, %llu solutions with them, %llu bases of the certificate\n",
        static_cast<unsigned long long>(counts.modes.modal_bases),
        static_cast<unsigned long long>(counts.modes.modal_solves),
        static_cast<unsigned long long>(counts.certificate_bases));
  }
  if (counts.modes.passed > 0) {
    std::printf("        %llu times a mode passed a point as its dense output went on\n",
                static_cast<unsigned long long>(counts.modes.passed));
  }
  std::printf(
      "  time  %s s: equilibrium %s, reduction %s, modes %s, differentiation %s, certificate %s, matching "
      "%s, events "
      "%s, output %s\n",
      rounded(result.seconds, 3).c_str(), percent(counts.equilibrium_seconds, result.seconds).c_str(),
      percent(counts.reduction_seconds, result.seconds).c_str(),
      percent(counts.modes_seconds, result.seconds).c_str(),
      percent(counts.differentiation_seconds, result.seconds).c_str(),
      percent(counts.certificate_seconds, result.seconds).c_str(),
      percent(counts.matching_seconds, result.seconds).c_str(),
      percent(counts.events_seconds, result.seconds).c_str(),
      percent(counts.output_seconds, result.seconds).c_str());
}

/// Prints the largest errors that the data of the model cause, relative to max(|s|, reference).
void print_data_errors(const DataErrors& errors, const RecordedPath& path, double reference) {
  const auto largest = [&](const Matrix& bounds, Eigen::Index& at) {
    double most = 0.0;
    for (Eigen::Index step = 0; step < bounds.rows(); ++step) {
      for (Eigen::Index mode = 0; mode < bounds.cols(); ++mode) {
        const double size = std::max(std::abs(path.eigenvalues(step, mode)), reference);
        const double relative = bounds(step, mode) / size;
        if (!(relative > most)) continue;
        most = relative;
        at = mode;
      }
    }
    return most;
  };
  const auto text = [&](const char* what, const Matrix& bounds) {
    Eigen::Index mode = 0;
    const double most = largest(bounds, mode);
    return std::string(what) + " up to " + rounded(most, 2) + " (mode " + std::to_string(mode + 1) + ")";
  };
  std::printf("  data  relative error of eigenvalues %s",
              text("between samples", errors.interpolation).c_str());
  if (errors.digits.array().isNaN().all() || !((errors.digits.array() > 0.0).any())) {
    std::printf("\n");
  } else {
    std::printf(", %s\n", text("from their digits", errors.digits).c_str());
  }
}

/// Prints how much of the loci is certified, the events, and the notes of the trace.
void print_findings(const TraceOptions& options, const TraceResult& result, const DataErrors* errors) {
  if (!options.certify) {
    std::printf("  identity  not certified (--no-certify)\n");
  } else if (result.certified_steps == result.mode_steps) {
    std::printf("  identity  certified on every step\n");
  } else {
    std::printf("  identity  NOT certified on %ld of %ld mode steps; info and the file say where\n",
                result.mode_steps - result.certified_steps, result.mode_steps);
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < result.events.size(); ++i) {
    rows.push_back(event_row(result.events[i], options.parameter));
    if (errors == nullptr || !std::isfinite(errors->intervals[i].from)) continue;
    std::string& remark = rows.back().back();
    const std::string interval = interval_text(errors->intervals[i], options.from, result.reached);
    remark += (remark.empty() || interval.empty() ? "" : ", ") + interval;
  }
  if (!rows.empty()) std::printf("  special points\n");
  print_table(rows);
  for (const std::string& note : result.notes) std::printf("  note  %s\n", note.c_str());
}

void print_effects(const Model& model, const EvaluationCounts& counts) {
  std::string line;
  for (std::size_t i = 0; i < model.description().effects.size(); ++i) {
    const std::uint64_t evaluations = counts.residual[i] + counts.linearization[i];
    if (evaluations == 0) continue;
    line +=
        (line.empty() ? "" : ", ") + model.description().effects[i].name + " " + std::to_string(evaluations);
  }
  std::printf("  evaluations  %s\n", line.c_str());
}

/// To which modes the stable ranges refer, in words; empty if to all.
std::string followed_modes(const TraceResult& result) {
  if (result.n_modes == result.n_available) return "";
  return std::to_string(result.n_modes) + " of " + std::to_string(result.n_available) + " modes followed";
}

void print_summary(const Scene& scene, const Model& model, const TraceOptions& options,
                   const TraceResult& result, const RecordedPath& path, const std::vector<std::string>& names,
                   const std::vector<StableRange>& ranges, const DataErrors* errors) {
  const std::string& unit = model.description().parameters.at(options.parameter).unit;
  if (!scene.title.empty()) std::printf("%s\n", printable(scene.title).c_str());
  std::printf("  %s  %s -> %s%s, tolerance %s, %s, %d of %d modes, %lld freedoms\n",
              options.parameter.c_str(), exact_text(options.from).c_str(), exact_text(result.reached).c_str(),
              (unit.empty() ? unit : ' ' + unit).c_str(), exact_text(options.tolerance).c_str(),
              order_text(result.order, !options.order).c_str(), result.n_modes, result.n_available,
              static_cast<long long>(result.n_independent));
  if (const Projection* projection = model.projection()) print_projection(*projection, options.parameter);
  if (result.n_infinite > 0) {
    std::printf("  %d infinite eigenvalues at the start are not followed (singular mass)\n",
                result.n_infinite);
  }
  std::vector<std::vector<std::string>> rows{
      {"mode", "s at " + exact_text(options.from), "s at " + exact_text(result.reached), "what moves"}};
  const auto text = [](Complex s) {
    return std::isnan(s.real()) ? std::string("-") : complex_text(s.real(), s.imag(), 8);
  };
  const Eigen::Index last = path.eigenvalues.rows() - 1;
  // A mode that was found on the step at which the trace was stopped has no column yet.
  const int columns = std::min(result.n_columns, static_cast<int>(path.eigenvalues.cols()));
  for (int mode = 0; mode < columns; ++mode) {
    // A pair that only rounding took for two real modes at the start has a second number, and no eigenvalue.
    if (path.eigenvalues.col(mode).array().isNaN().all()) continue;
    rows.push_back({std::to_string(mode + 1), text(path.eigenvalues(0, mode)),
                    text(path.eigenvalues(last, mode)), cell_text(names[static_cast<std::size_t>(mode)])});
  }
  print_table(rows);
  if (errors != nullptr) print_data_errors(*errors, path, result.s_ref);
  print_findings(options, result, errors);
  print_permanent(path, {options.tolerance, result.s_ref}, names);
  print_ranges(ranges, options.parameter, followed_modes(result));
  print_work(result);
  print_effects(model, result.counts.evaluations);
}

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
    writer_.emplace(arguments_.output, *setup_.model, setup_.options, saved, arguments_.save_every);
    saved_points_ = static_cast<int>(saved.path.n_nodes());
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
                        arguments_.save_every);
      }
      writer_->append(point);
      recorder_.append(point);
      const TraceOptions& options = setup_.options;
      progress_.update((point.node.p - options.from) / (options.to - options.from), recorder_.points());
      return true;
    };
    observer.checkpoint = [this](const Checkpoint& checkpoint) {
      if (!interruption_) {
        if (writer_->checkpoint(checkpoint)) saved_points_ = recorder_.points();
        return true;
      }
      interruption_.save_in_peace();
      writer_->interrupt(checkpoint);
      interrupted_ = true;
      saved_points_ = recorder_.points();
      return false;
    };
    return observer;
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
    const RecordedPath path = recorder_.path();
    const EigenvalueAccuracy accuracy{setup_.options.tolerance, result_.s_ref};
    std::vector<StableRange> ranges = stable_ranges(path, result_.events, accuracy);
    std::optional<DataErrors> errors = data_errors(*setup_.model, setup_.options, path, result_.events);
    const int shallow = errors ? remove_shallow_extrema(path, result_.events, *errors) : 0;
    if (shallow > 0)
      result_.notes.push_back(std::to_string(shallow) + (shallow == 1 ? " extremum" : " extrema") +
                              " of damping ratios left out: no deeper than the errors of the data");
    if (errors) ranges = with_undecided(ranges, path, result_.events, *errors, accuracy);
    writer_->finish(result_, ranges, errors ? &*errors : nullptr);
    if (!arguments_.quiet) {
      print_summary(setup_.scene, *setup_.model, setup_.options, result_, path, writer_->mode_names(), ranges,
                    errors ? &*errors : nullptr);
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
    throw InputError("--save-reduced: the model is not projected; it is for sparse families of which some modes "
                     "are followed");
  const std::string scene = write_projected(arguments.save_reduced, setup.scene, *family, arguments.force);
  if (!arguments.quiet)
    std::printf("wrote %s and its scene %s\n", arguments.save_reduced.c_str(), scene.c_str());
}

int run_trace(const TraceArguments& arguments) {
  if (std::isnan(arguments.save_every))
    throw InputError("--save-every: expected a number of seconds, found nan");
  TraceSetup setup =
      prepare_trace(read_scene(arguments.scene), {arguments.options.begin(), arguments.options.end()});
  project_if_large(setup.model, setup.options);
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

/// The command line flag of an option of the trace: "max_step" becomes --max-step.
std::string flag(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<TraceArguments>();
  CLI::App* command =
      program.add_subcommand("trace", "follow the eigenvalues of a scene and write a loci file");
  command->add_option("SCENE", arguments->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", arguments->output, "loci file to write (HDF5)")->required();
  const auto force = command->add_flag("--force", arguments->force, "replace an existing output");
  command
      ->add_flag("--resume", arguments->resume,
                 "go on with an output that was interrupted; begin where there is none")
      ->excludes(force);
  command
      ->add_option("--save-every", arguments->save_every,
                   "seconds of work that may be lost when the program is killed")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--save-reduced", arguments->save_reduced,
                      "large models: write the projected matrices as a family of their own (HDF5; the scene "
                      "that names them is written beside it)");
  command->add_flag("-q,--quiet", arguments->quiet, "no progress bar, no summary");
  TraceOptions defaults;
  TraceOptions::fields(defaults, [&](const char* key, const char* help, const auto&) {
    const std::string name = key;
    if (name == "certify") return;  // a flag, below
    command->add_option_function<std::string>(
        flag(name), [arguments, name](const std::string& text) { arguments->options[name] = text; },
        std::string(help) + " (overrides the scene)");
  });
  command->add_flag_callback(
      "--no-certify", [arguments] { arguments->options["certify"] = "false"; },
      "no certificate at every step that no modes were exchanged: faster, and compares shapes only");
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
  command->callback([arguments, &exit_code] { exit_code = run_trace(*arguments); });
}

}  // namespace eigentrail::app
