#include <array>
#include <charconv>
#include <cstdio>
#include <map>
#include <memory>

#include "accuracy_report.hpp"
#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "parts.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"

namespace eigentrail::app {
namespace {

struct AccuracyArguments : SceneArguments {
  bool writes = false;
  OutputChoice output;
  std::map<std::string, std::string> lists;  ///< per flag: the list of numbers as text
  StudyOptions options;
  std::map<std::string, std::string> trace_options;  ///< overrides of the scene's [trace]
};

/// Reads numbers separated by commas; "none" is the empty list. `numbers` keeps its value if the flag was not
/// given.
template <class Number>
void read_list(const AccuracyArguments& arguments, const std::string& flag, std::vector<Number>& numbers) {
  const auto given = arguments.lists.find(flag);
  if (given == arguments.lists.end()) return;
  const std::string& text = given->second;
  numbers.clear();
  if (text == "none") return;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (;;) {
    Number number{};
    const auto parsed = std::from_chars(at, end, number);
    const bool ends = parsed.ptr == end;
    if (parsed.ec != std::errc() || (!ends && *parsed.ptr != ','))
      throw InputError(flag + ": expected numbers separated by commas; found '" + text + "'");
    numbers.push_back(number);
    if (ends) return;
    at = parsed.ptr + 1;
  }
}

void check_options(const StudyOptions& options) {
  std::string message;
  for (const std::string& fault : find_faults(options)) message += (message.empty() ? "--" : "; --") + fault;
  if (!message.empty()) throw InputError(message);
}

/// What the study depends on.
SharedRun shared_run(const TraceSetup& setup, const AccuracyArguments& arguments) {
  SharedRun run{"accuracy", setup.scene.path, settings_of(setup.scene)};
  run.settings.insert(run.settings.end(), arguments.lists.begin(), arguments.lists.end());
  run.settings.emplace_back("--samples", std::to_string(arguments.options.samples));
  run.settings.emplace_back("--repeat", std::to_string(arguments.options.repeat));
  for (const auto& [key, text] : arguments.trace_options) run.settings.emplace_back("--" + key, text);
  return run;
}

int run_accuracy(AccuracyArguments& arguments, Team& team) {
  OutputChoice& output = arguments.output;
  StudyOptions& options = arguments.options;
  read_list(arguments, "--tolerances", options.tolerances);
  read_list(arguments, "--orders", options.orders);
  read_list(arguments, "--grids", options.grids);
  check_options(options);
  TraceSetup setup =
      prepare_trace(given_scene(arguments), {arguments.trace_options.begin(), arguments.trace_options.end()});
  warn_of_unused(setup.scene, *setup.model);
  project_if_large(setup.model, setup.options);
  const SharedRun run = shared_run(setup, arguments);
  if (arguments.writes && has_ended(output, team, run)) return done;
  std::unique_ptr<UnfinishedRun> unfinished;
  std::unique_ptr<Workers> workers = team.workers(1);
  if (arguments.writes) {
    unfinished = unfinished_run(output, run, {}, team);
    check_output(output.path, output.force, {accuracy_format, "work-precision study"});
    check_can_create(output.path);
    workers = std::make_unique<SavingWorkers>(std::move(workers), *unfinished);
  }
  ProgressBar progress(output.quiet);
  const Study study = accuracy_study(setup, options, *workers, [&](int done, int all) {
    progress.update(static_cast<double>(done) / all, done, "runs");
  });
  progress.finish();
  const auto finish = [&]() -> int {
    if (study.reference.samples.empty()) {
      std::fprintf(stderr, "eigentrail: %s: no reference could be computed anywhere on the range\n",
                   setup.scene.path.c_str());
      return numbers_failed;
    }
    if (!output.quiet) print_study(setup, study);
    if (!arguments.writes) return done;
    write_durably(output.path, {study_file(setup, options, study), run_mark(run)}, existing(output.force));
    if (!output.quiet) std::printf("wrote %s\n", output.path.c_str());
    return done;
  };
  return unfinished ? end_run(*unfinished, finish) : finish();
}

}  // namespace

void add_accuracy(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<AccuracyArguments>();
  CLI::App* command = program.add_subcommand(
      "accuracy", "work-precision study of a scene: the error really achieved, and what it costs");
  StudyOptions& options = arguments->options;
  add_scene(*command, *arguments);
  auto* output =
      command->add_option("-o,--output", arguments->output.path, "file to write (HDF5); default: none");
  for (const auto& [flag, help] :
       {std::array{"--tolerances", "tolerances to trace with: A,B,... (1e-2,1e-3,...,1e-12)"},
        std::array{"--orders", "orders of the power series: A,B,... (1,2,3,4)"},
        std::array{"--grids",
                   "points of the grids of the other methods: A,B,..., or none (25,50,...,800)"}}) {
    command->add_option_function<std::string>(
        flag,
        [arguments, flag = std::string(flag)](const std::string& text) { arguments->lists[flag] = text; },
        help);
  }
  command->add_option("--samples", options.samples, "parameter values at which errors are measured")
      ->capture_default_str();
  command->add_option("--repeat", options.repeat, "runs whose median time counts")->capture_default_str();
  for (const auto& [flag, key, help] :
       {std::array{"--parameter", "parameter", "name of the traced parameter"},
        std::array{"--from", "from", "where the range begins"}, std::array{"--to", "to", "where it ends"}}) {
    command->add_option_function<std::string>(
        flag,
        [arguments, key = std::string(key)](const std::string& text) {
          arguments->trace_options[key] = text;
        },
        std::string(help) + " (overrides the scene)");
  }
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n  eigentrail accuracy data/scenes/rotating_mass.toml --tolerances 1e-4,1e-8 -o study.h5");
  command->callback([arguments, output, &exit_code] {
    arguments->writes = output->count() > 0;
    exit_code = alone([&](Team& team) { return run_accuracy(*arguments, team); });
  });
}

}  // namespace eigentrail::app
