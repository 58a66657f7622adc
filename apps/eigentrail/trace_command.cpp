#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/model/build.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "output.hpp"
#include "progress_bar.hpp"
#include "ranges.hpp"

namespace eigentrail::app {
namespace {

struct TraceArguments {
  std::string scene;
  std::string output;
  bool force = false;
  bool quiet = false;
  int threads = 0;                             ///< 0: one per core
  std::map<std::string, std::string> options;  ///< overrides of the scene's [trace]
};

/// Ends of the followed loci, for the summary: by mode, from 0.
struct Ends {
  std::map<int, Complex> first, last;
};

/// A file that cannot be created is a matter of the command line; one that cannot be written to later is not.
void create_output(std::optional<LociWriter>& writer, const std::string& path, const TraceSetup& setup,
                   const TraceStart& start) {
  try {
    writer.emplace(path, setup.scene, *setup.model, setup.options, start);
  } catch (const std::exception& error) {
    throw InputError(path + ": cannot be created: " + error.what());
  }
}

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

/// How much of the loci is certified, special points, and what else the user should know.
void print_findings(const TraceOptions& options, const TraceResult& result) {
  if (!options.certify) {
    std::printf("  identity  not certified (--no-certify)\n");
  } else if (result.certified_steps == result.mode_steps) {
    std::printf("  identity  certified on every step\n");
  } else {
    std::printf("  identity  NOT certified on %ld of %ld mode steps; info and the file say where\n",
                result.mode_steps - result.certified_steps, result.mode_steps);
  }
  std::vector<std::vector<std::string>> rows;
  for (const Event& event : result.events) rows.push_back(event_row(event, options.parameter));
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

/// Of which modes the stable ranges speak, when not of all.
std::string followed_modes(const TraceResult& result) {
  if (result.n_modes == result.n_available) return "";
  return std::to_string(result.n_modes) + " of " + std::to_string(result.n_available) + " modes followed";
}

void print_summary(const Scene& scene, const Model& model, const TraceOptions& options,
                   const TraceResult& result, const Ends& ends, const std::vector<std::string>& names,
                   const std::vector<StableRange>& ranges) {
  const std::string& unit = model.description().parameters.at(options.parameter).unit;
  if (!scene.title.empty()) std::printf("%s\n", printable(scene.title).c_str());
  std::printf("  %s  %s -> %s%s, tolerance %s, %s, %d of %d modes, %lld freedoms\n",
              options.parameter.c_str(), exact_text(options.from).c_str(), exact_text(result.reached).c_str(),
              (unit.empty() ? unit : ' ' + unit).c_str(), exact_text(options.tolerance).c_str(),
              order_text(result.order, !options.order).c_str(), result.n_modes, result.n_available,
              static_cast<long long>(result.n_independent));
  if (result.n_infinite > 0) {
    std::printf("  %d infinite eigenvalues at the start are not followed (singular mass)\n",
                result.n_infinite);
  }
  std::vector<std::vector<std::string>> rows{
      {"mode", "s at " + exact_text(options.from), "s at " + exact_text(result.reached), "what moves"}};
  const auto text = [](const std::map<int, Complex>& ends_of, int mode) {
    const auto found = ends_of.find(mode);
    return found == ends_of.end() ? std::string("-")
                                  : complex_text(found->second.real(), found->second.imag(), 8);
  };
  for (int mode = 0; mode < result.n_columns; ++mode) {
    rows.push_back({std::to_string(mode + 1), text(ends.first, mode), text(ends.last, mode),
                    printable(names[static_cast<std::size_t>(mode)])});
  }
  print_table(rows);
  print_findings(options, result);
  print_ranges(ranges, options.parameter, followed_modes(result));
  print_work(result);
  print_effects(model, result.counts.evaluations);
}

int run_trace(const TraceArguments& arguments) {
  TraceSetup setup =
      prepare_trace(read_scene(arguments.scene), {arguments.options.begin(), arguments.options.end()});
  setup.options.threads = arguments.threads > 0
                              ? arguments.threads
                              : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Scene& scene = setup.scene;
  const TraceOptions& options = setup.options;
  const Model& model = *setup.model;
  check_parameter_name(scene, options.parameter);
  check_output(arguments.output, arguments.force, {loci_format, "loci file"});

  std::optional<LociWriter> writer;
  std::optional<TraceStart> started;
  ProgressBar progress(arguments.quiet);
  PathRecorder recorder;
  Ends ends;
  int points = 0;
  TraceObserver observer;
  observer.started = [&](const TraceStart& start) { started = start; };
  observer.point = [&](const TracePoint& point) {
    const auto values = [&point] {
      std::map<int, Complex> all;
      for (const ModeState& state : point.modes) all[state.mode] = state.s;
      return all;
    };
    if (!writer) {
      create_output(writer, arguments.output, setup, *started);
      ends.first = values();
    }
    writer->append(point);
    recorder.append(point);
    ends.last = values();
    progress.update((point.node.p - options.from) / (options.to - options.from), ++points);
    return true;
  };
  const TraceResult result = trace(model, options, observer);
  if (!has_started(result.status)) throw InputError(scene.path + ": " + result.message);
  const std::vector<StableRange> ranges =
      stable_ranges(recorder.path(), result.events, {options.tolerance, result.s_ref});
  writer->finish(result, ranges);
  progress.finish();

  if (!arguments.quiet) {
    print_summary(scene, model, options, result, ends, writer->mode_names(), ranges);
    std::printf("wrote %s\n", arguments.output.c_str());
  }
  if (result.status == TraceStatus::completed) return done;
  std::fprintf(stderr, "eigentrail: %s; the points before it are in %s\n", result.message.c_str(),
               arguments.output.c_str());
  return numbers_failed;
}

/// An option of the trace as a flag: "max_step" becomes --max-step.
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
  command->add_flag("--force", arguments->force, "replace an existing output");
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
      "  eigentrail trace scene.toml -o out.h5 --from 100 --to 5 --tolerance 1e-8 --modes 4");
  command->callback([arguments, &exit_code] { exit_code = run_trace(*arguments); });
}

}  // namespace eigentrail::app
