#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "eigentrail/store/output_file.hpp"
#include "parts.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"
#include "sweep_run.hpp"
#include "trace_flags.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

constexpr std::size_t most_runs = 1'000'000;

struct SweepArguments : SceneArguments {
  std::vector<std::string> vary;  ///< NAME=VALUES
  OutputChoice output;            ///< a folder
  std::optional<Part> part;
  int jobs = 0;
  SaveOptions saving;
  std::map<std::string, std::string> options;  ///< overrides of the scene's [trace]
};

/// Reads the texts of --vary.
Combinations read_combinations(const SweepArguments& arguments, const Scene& scene) {
  std::vector<Varied> varied;
  const auto given = arguments.options.find("parameter");
  const std::string traced = given == arguments.options.end() ? traced_parameter(scene) : given->second;
  double runs = 1.0;
  for (const std::string& text : arguments.vary) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (name.empty() || equals == std::string::npos || equals + 1 == text.size())
      throw InputError("--vary " + text + ": expected NAME=VALUES, such as --vary drag=5,10,20");
    const std::string label = "--vary " + name;
    const auto index = scene.parameters.index(name);
    if (!index)
      throw InputError(label + ": no parameter is called '" + name + "'; " +
                       suggestion(name, scene.parameters.names()));
    if (name == traced)
      throw InputError(label + ": '" + name + "' is the traced parameter; its values are those of the trace");
    if (is_trimmed(scene, name))
      throw InputError(label + ": '" + name + "' is the unknown of a [[trim]]; vary another parameter");
    const bool twice =
        std::any_of(varied.begin(), varied.end(), [&](const Varied& one) { return one.name == name; });
    if (twice) throw InputError(label + ": is there twice; give all values in one list");
    varied.push_back({name, read_values(label, {text.substr(equals + 1)},
                                        scene.parameters[static_cast<std::size_t>(*index)])});
    runs *= static_cast<double>(varied.back().values.size());
  }
  if (runs > static_cast<double>(most_runs))
    throw InputError("--vary: more than " + std::to_string(most_runs) + " combinations");
  return Combinations(std::move(varied));
}

/// "run_007.h5": as many digits as the last run has, three at least, so that names sort as runs do.
std::string run_name(std::size_t number, std::size_t runs) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(runs).size());
  const std::string text = std::to_string(number + 1);
  return "run_" + std::string(digits - text.size(), '0') + text + ".h5";
}

bool is_index(const std::string& path) {
  std::ifstream file(path);
  std::string begin(9, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == "run,file,";
}

void check_index(const std::string& path, bool force) {
  check_output(path, force, OtherOutput{is_index, "index of a sweep"});
  check_can_create(path);
}

/// Makes the folder if it is not there, and checks the files that will be written into it.
void check_folder(const std::string& folder, bool force, const std::vector<std::size_t>& runs,
                  std::size_t n_runs) {
  if (folder.empty()) throw InputError("--output: expected the name of a folder");
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder + ": cannot be made a folder" + (error ? ": " + error.message() : ""));
  for (const std::size_t run : runs)
    check_output((std::filesystem::path(folder) / run_name(run, n_runs)).string(), force,
                 {"eigentrail-loci", "loci file"});
}

/// Whether there is an index with a line for each run, and loci files of these runs. Throws InputError if
/// they are of other input.
bool has_index(const std::string& index, const std::function<std::string(std::size_t)>& path,
               const Scene& scene, const Combinations& runs, const OptionTexts& options) {
  std::ifstream file(index, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  if (!text.starts_with(index_header(runs.varied())) || lines != runs.size() + 1) return false;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (std::filesystem::exists(path(run)))
      require_run_of_sweep(scene, runs.settings(run), options, path(run));
  }
  return true;
}

/// Writes the index and says how many runs there are.
int finish_sweep(const std::string& header, const std::vector<std::string>& lines,
                 const OutputChoice& output) {
  std::string text = header;
  std::size_t failed = 0;
  std::string first_failure;
  for (const std::string& bytes : lines) {
    // A piece is the exit code and the line of the index.
    text += bytes.substr(1);
    if (bytes.front() == '0') continue;
    if (failed++ == 0) first_failure = bytes.substr(1, bytes.find(',') - 1);
  }
  const std::string& index = output.path;
  write_durably(index, {text}, existing(output.force));
  if (!output.quiet)
    std::printf("wrote %s: %zu runs, %zu of them failed\n", index.c_str(), lines.size(), failed);
  if (failed == 0) return done;
  std::fprintf(stderr, "eigentrail: %zu of %zu runs failed, first run %s; %s has the reasons\n", failed,
               lines.size(), first_failure.c_str(), index.c_str());
  return numbers_failed;
}

SharedRun shared_run(const Scene& scene, const SweepArguments& arguments, const Combinations& runs) {
  SharedRun run{"sweep", scene.path, settings_of(scene), runs.size()};
  for (const Varied& one : runs.varied()) {
    std::string values;
    for (const double value : one.values) values += (values.empty() ? "" : ",") + exact_text(value);
    run.settings.emplace_back("--vary " + one.name, values);
  }
  for (const auto& [key, text] : arguments.options) run.settings.emplace_back("option " + key, text);
  run.settings.emplace_back("header", index_header(runs.varied()));
  return run;
}

int run_sweep(SweepArguments& arguments, Team& team) {
  const Scene scene = given_scene(arguments);
  const Combinations runs = read_combinations(arguments, scene);
  const std::vector<std::size_t> numbers = arguments.part.value_or(Part{}).pieces(runs.size());
  const std::filesystem::path folder = arguments.output.path;
  OutputChoice part_file = arguments.output;
  if (arguments.part)
    part_file.path = (folder / ("part-" + std::to_string(arguments.part->number) + "-of-" +
                                std::to_string(arguments.part->count) + ".h5"))
                         .string();
  OutputChoice index = arguments.output;
  index.path = (folder / "index.csv").string();
  OutputChoice& list = arguments.part ? part_file : index;
  const SharedRun run = shared_run(scene, arguments, runs);
  const OptionTexts options(arguments.options.begin(), arguments.options.end());
  const auto path = [&](std::size_t number) { return (folder / run_name(number, runs.size())).string(); };
  const bool ended = arguments.part ? has_ended(list, team, run, arguments.part) : has_ended(list, team, [&] {
    return has_index(list.path, path, scene, runs, options);
  });
  if (ended) return done;
  const auto unfinished = unfinished_run(list, run, arguments.part, team);
  if (team.leads()) {
    check_folder(arguments.output.path, list.force, numbers, runs.size());
    arguments.part ? check_part_output(list) : check_index(list.path, list.force);
    unfinished->begin();
  }
  arguments.saving.existing = existing(list.force);
  SavingWorkers workers(team.workers(arguments.jobs), *unfinished);
  ProgressBar progress(arguments.output.quiet);
  const auto trace_one = [&](std::size_t number) {
    SweepRow row = run_of_sweep(scene, runs.settings(number), options, path(number), arguments.saving);
    row.run = number + 1;
    row.values = runs.values(number);
    return std::to_string(row.exit_code) + index_line(row);
  };
  std::vector<std::string> lines = workers.compute(
      {"run", numbers, trace_one}, [&](std::size_t finished, std::size_t, const std::string&) {
        progress.update(static_cast<double>(finished) / static_cast<double>(numbers.size()),
                        static_cast<int>(finished), "runs");
      });
  progress.finish();
  if (!team.leads()) return done;
  return end_run(*unfinished, [&] {
    if (arguments.part) return write_part(part_file, run, *arguments.part, std::move(lines));
    return finish_sweep(index_header(runs.varied()), lines, index);
  });
}

}  // namespace

int merge_sweep(const SharedRun& run, const std::vector<std::string>& pieces, const OutputChoice& output,
                Team& team) {
  if (!team.leads()) return done;
  check_index(output.path, output.force);
  return finish_sweep(run.setting("header").value_or(""), pieces, output);
}

void add_sweep(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<SweepArguments>();
  CLI::App* command = program.add_subcommand(
      "sweep", "trace a scene for all combinations of values of some parameters, on all cores");
  add_scene(*command, *arguments);
  command
      ->add_option(
          "--vary", arguments->vary,
          "NAME=VALUES: a parameter and its values, as a list 5,10,20 or a range begin:step:end; may "
          "be repeated, the last one changes fastest")
      ->required()
      ->allow_extra_args(false);
  auto* output = command->add_option(
      "-o,--output", arguments->output.path,
      "folder for the loci files and their index (index.csv); default: SCENE_sweep, here");
  add_part(*command, arguments->part);
  command->add_option("--jobs", arguments->jobs, "runs at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
  add_output_flags(*command, arguments->output, "replace existing files of the same runs");
  add_no_lock(*command, arguments->saving);
  add_trace_options(*command, arguments->options);
  command->footer(
      "Example:\n"
      "  eigentrail sweep data/scenes/rotating_mass.toml --vary drag=5,10,20 --vary a_n=500:500:2000 -o "
      "drag");
  command->callback([arguments, output, &exit_code] {
    if (output->count() == 0) arguments->output.path = beside(arguments->scene, "_sweep");
    exit_code = together([&](Team& team) { return run_sweep(*arguments, team); });
  });
}

}  // namespace eigentrail::app
