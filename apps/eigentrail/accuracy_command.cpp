#include <array>
#include <charconv>
#include <cstdio>
#include <map>

#include "accuracy_report.hpp"
#include "commands.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/store/accuracy_writer.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"

namespace eigentrail::app {
namespace {

struct AccuracyArguments : SceneArguments {
  OutputChoice output;
  std::map<std::string, std::string> lists;  ///< per flag: the list of numbers as text
  StudyOptions study;
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
  run.settings.emplace_back("--samples", std::to_string(arguments.study.samples));
  run.settings.emplace_back("--repeat", std::to_string(arguments.study.repeat));
  for (const auto& [key, text] : arguments.options) run.settings.emplace_back("--" + key, text);
  return run;
}

int finish_study(const TraceSetup& setup, const AccuracyArguments& arguments, const SharedJob& job,
                 const Study& study) {
  const OutputChoice& output = arguments.output;
  if (study.reference.samples.empty()) {
    std::fprintf(stderr, "eigentrail: %s: no reference could be computed anywhere on the range\n",
                 setup.scene.path.c_str());
    return numbers_failed;
  }
  if (!output.quiet) print_study(setup, study);
  if (job.writes) write_result(output, job.run, study_file(setup, arguments.study, study), [] {});
  return done;
}

int run_accuracy(AccuracyArguments& arguments, Team& team) {
  StudyOptions& options = arguments.study;
  read_list(arguments, "--tolerances", options.tolerances);
  read_list(arguments, "--orders", options.orders);
  read_list(arguments, "--grids", options.grids);
  check_options(options);
  TraceSetup setup = given_setup(arguments);
  project_if_large(setup.model, setup.options);
  SharedJob job{shared_run(setup, arguments), hdf5_format(accuracy_format, "work-precision study"), 1};
  job.writes = arguments.output.given->count() > 0;
  Study study;
  job.compute = [&](const std::vector<std::size_t>&, Workers& workers, ProgressBar& progress) {
    study = accuracy_study(setup, options, workers, [&](int done, int all) {
      progress.update(static_cast<double>(done) / all, done, "runs");
    });
    return std::vector<std::string>();
  };
  job.finish = [&](const std::vector<std::string>&, Workers&, std::optional<double>) {
    return finish_study(setup, arguments, job, study);
  };
  return carry_out(job, arguments.output, team);
}

}  // namespace

void add_accuracy(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<AccuracyArguments>(
      program, exit_code, in_team(run_accuracy, alone), "accuracy",
      "work-precision study of a scene: the error really achieved, and what it costs");
  StudyOptions& options = arguments->study;
  add_scene(*command, *arguments);
  add_output(*command, arguments->output, "file to write (HDF5); default: none");
  for (const auto& [flag, help] :
       {std::array{"--tolerances", "tolerances to trace with: A,B,... (1e-2,1e-3,...,1e-12)"},
        std::array{"--orders", "orders of the power series: A,B,... (1,2,3,4)"},
        std::array{"--grids",
                   "points of the grids of the other methods: A,B,..., or none (25,50,...,800)"}}) {
    add_text(*command, flag, arguments->lists, flag, help);
  }
  command->add_option("--samples", options.samples, "parameter values at which errors are measured")
      ->capture_default_str();
  command->add_option("--repeat", options.repeat, "runs whose median time counts")->capture_default_str();
  add_override(*command, *arguments, "parameter", "name of the traced parameter");
  add_override(*command, *arguments, "from", "where the range begins");
  add_override(*command, *arguments, "to", "where it ends");
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n  eigentrail accuracy data/scenes/rotating_mass.toml --tolerances 1e-4,1e-8 -o study.h5");
}

}  // namespace eigentrail::app
