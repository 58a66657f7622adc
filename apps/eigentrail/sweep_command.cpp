#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "core/hdf5_writer.hpp"
#include "core/texts.hpp"
#include "eigentrail/accuracy/recorded_trace.hpp"
#include "eigentrail/continuation/recorded_path.hpp"
#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "eigentrail/scene/settings.hpp"
#include "eigentrail/scene/traced_parameter.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/saved_trace.hpp"
#include "output.hpp"
#include "records.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

/// A parameter that a sweep varies, and its values in the parameter's unit.
struct Varied {
  std::string name;
  std::vector<double> values;
};

/// All combinations of the values, the last parameter changing fastest.
class Combinations {
 public:
  explicit Combinations(std::vector<Varied> varied) : varied_(std::move(varied)) {}

  std::size_t size() const {
    std::size_t product = 1;
    for (const Varied& one : varied_) product *= one.values.size();
    return product;
  }
  /// The values of a combination, counted from 0, in the order of the parameters.
  std::vector<double> values(std::size_t number) const {
    std::vector<double> values(varied_.size());
    for (std::size_t i = varied_.size(); i-- > 0;) {
      const std::size_t count = varied_[i].values.size();
      values[i] = varied_[i].values[number % count];
      number /= count;
    }
    return values;
  }
  const std::vector<Varied>& varied() const { return varied_; }

  /// NAME=VALUE of each parameter.
  std::vector<std::string> settings(std::size_t number) const {
    const std::vector<double> of_run = values(number);
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < of_run.size(); ++k)
      settings.push_back(varied_[k].name + "=" + exact_text(of_run[k]));
    return settings;
  }

 private:
  std::vector<Varied> varied_;
};

/// The least damping ratio -Re s / |s| of the complex pairs of a path, and where it is, at the points of the
/// trace and at places between them; NaN if it has no pairs.
struct LeastDamping {
  double ratio = NAN, p = NAN;
};

/// What a run has come to: a line of the index of the sweep. Numbers that are not known are NaN.
struct SweepRow {
  std::size_t run = 0;         ///< from 1
  std::string file;            ///< the loci file's name; empty if none was written
  std::vector<double> values;  ///< of the varied parameters
  int exit_code = 0;           ///< that of `eigentrail trace`
  int points = 0;
  double reached = NAN;                    ///< last value of the traced parameter
  double flutter = NAN, divergence = NAN;  ///< where the first one of the trace is
  LeastDamping damping = {};
  std::string reason;  ///< why the run failed; empty if it did not
};

/// Places of a step at which damping ratios are looked at, beside its ends.
constexpr int places_per_step = 16;

/// NaN if there is none.
double first_of(Onset onset, const std::vector<Event>& events, const std::vector<StableRange>& ranges,
                double from) {
  double first = NAN;
  const auto take = [&](double p) {
    if (std::isnan(first) || std::abs(p - from) < std::abs(first - from)) first = p;
  };
  for (const Event& event : events) {
    if (onset_at(event, ranges) == onset) take(event.p);
  }
  for (const StableRange& range : ranges) {
    for (const RangeEnd& end : {range.from, range.to})
      if (onset == Onset::divergence && end.cause == "infinity") take(end.p);
  }
  return first;
}

TraceSetup setup_of(const Scene& scene, const std::vector<std::string>& settings,
                    const OptionTexts& options) {
  const Hdf5Turn turn;
  return prepare_trace(with_settings(scene, settings).scene, options);
}

LeastDamping least_damping(const RecordedPath& path) {
  LeastDamping least;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    for (int k = 0; k <= places_per_step; ++k) {
      const PathPosition at{step, static_cast<double>(k) / places_per_step};
      for (const Complex s : path.eigenvalues_at(at)) {
        if (!std::isfinite(std::abs(s)) || s.imag() == 0.0) continue;
        const double ratio = -s.real() / std::abs(s);
        if (std::isnan(least.ratio) || ratio < least.ratio) least = {ratio, path.parameter_at(at)};
      }
    }
  }
  return least;
}

void trace_into(SweepRow& row, const TraceSetup& setup, const std::string& path, const SaveOptions& saving) {
  RecordedTrace recorded(setup, {}, path, saving);
  const TraceResult& result = recorded.begin();
  if (!has_started(result.status)) throw InputError(setup.scene.path + ": " + result.message);
  const Findings found = recorded.find();
  recorded.finish(found);
  row.file = std::filesystem::path(path).filename().string();
  row.points = result.nodes;
  row.reached = result.reached;
  row.flutter = first_of(Onset::flutter, result.events, found.ranges, setup.options.from);
  row.divergence = first_of(Onset::divergence, result.events, found.ranges, setup.options.from);
  row.damping = least_damping(found.path);
  row.exit_code = result.status == TraceStatus::completed ? done : numbers_failed;
  row.reason = result.message;
}

/// First line and lines of the index, with their line ends.
std::string index_header(const std::vector<Varied>& varied) {
  std::vector<Cell> cells{"run", "file"};
  for (const Varied& one : varied) cells.emplace_back(one.name);
  for (const char* column :
       {"exit", "points", "reached", "flutter", "divergence", "least_damping", "least_damping_at", "reason"})
    cells.emplace_back(column);
  return csv_line(cells, "");
}

std::string index_line(const SweepRow& row) {
  std::vector<Cell> cells{count(row.run), row.file};
  cells.insert(cells.end(), row.values.begin(), row.values.end());
  cells.insert(cells.end(), {count(row.exit_code), count(row.points), row.reached, row.flutter,
                             row.divergence, row.damping.ratio, row.damping.p, printable(row.reason)});
  return csv_line(cells, "");
}

/// Traces `scene` with `settings` (NAME=VALUE) and writes the loci file `path`. An error ends up in the row.
/// May be called by several threads at once.
SweepRow run_of_sweep(const Scene& scene, const std::vector<std::string>& settings,
                      const OptionTexts& options, const std::string& path, const SaveOptions& saving) {
  SweepRow row;
  try {
    TraceSetup setup = setup_of(scene, settings, options);
    project_if_large(setup.model, setup.options);
    check_parameter_name(setup.scene, setup.options.parameter);
    trace_into(row, setup, path, saving);
  } catch (const std::exception& error) {
    row.exit_code = exit_code_of(error);
    row.reason = error.what();
  }
  return row;
}

constexpr std::size_t most_runs = 1'000'000;
constexpr const char* piece_kind = "run";

struct SweepArguments : SceneArguments {
  std::vector<std::string> vary;  ///< NAME=VALUES
  OutputChoice output;            ///< a folder
  int jobs = 0;
  SaveOptions saving;
};

/// Reads the texts of --vary.
Combinations read_combinations(const SweepArguments& arguments, const Scene& scene) {
  std::vector<Varied> varied;
  const std::string traced = arguments.traced(scene);
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
    const bool twice = std::ranges::any_of(varied, [&](const Varied& one) { return one.name == name; });
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

const OutputFormat index_format{"index of a sweep",
                                [](const std::string& path) { return begins_with(path, "run,file,"); }};

/// Makes the folder if it is not there, and checks the files that will be written into it.
void check_folder(const std::string& folder, bool force, const std::vector<std::size_t>& runs,
                  std::size_t n_runs) {
  if (folder.empty()) throw InputError("--output: expected the name of a folder");
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder + ": cannot be made a folder" + (error ? ": " + error.message() : ""));
  const OutputFormat loci_output = hdf5_format(loci_format, "loci file");
  for (const std::size_t run : runs)
    check_output((std::filesystem::path(folder) / run_name(run, n_runs)).string(), force, loci_output);
}

/// Whether there is an index with a line for each run, and loci files of these runs. Throws InputError if
/// they are of other input.
bool has_index(const std::string& index, const std::function<std::string(std::size_t)>& path,
               const Scene& scene, const Combinations& runs, const OptionTexts& options) {
  std::ifstream file(index, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  if (!text.starts_with(index_header(runs.varied())) || lines != runs.size() + 1) return false;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (!std::filesystem::exists(path(run))) continue;
    const TraceSetup setup = setup_of(scene, runs.settings(run), options);
    (void)read_saved_trace(path(run), setup.scene, setup.options);
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
  write_durably(index, {text}, output.existing());
  if (!output.quiet)
    std::printf("wrote %s: %zu runs, %zu of them failed\n", index.c_str(), lines.size(), failed);
  if (failed == 0) return done;
  std::fprintf(stderr, "eigentrail: %zu of %zu runs failed, first run %s; %s has the reasons\n", failed,
               lines.size(), first_failure.c_str(), index.c_str());
  return numbers_failed;
}

SharedRun shared_run(const Scene& scene, const SweepArguments& arguments, const Combinations& runs) {
  SharedRun run{"sweep", scene.path, settings_of(scene), runs.size()};
  for (const Varied& one : runs.varied())
    run.settings.emplace_back("--vary " + one.name, joined(one.values, ",", exact_text));
  for (const auto& [key, text] : arguments.options) run.settings.emplace_back("option " + key, text);
  run.settings.emplace_back("header", index_header(runs.varied()));
  return run;
}

SharedJob sweep_job(SharedRun run, const OutputChoice& output) {
  SharedJob job{std::move(run), index_format};
  job.finish = [header = job.run.setting("header").value_or(""), &output](const ComputedRun& lines) {
    return lines.leads ? finish_sweep(header, lines.pieces, output) : done;
  };
  return job;
}

int run_sweep(SweepArguments& arguments, Team& team) {
  arguments.output.name_like(arguments.scene, "_sweep");
  const Scene scene = given_scene(arguments);
  const Combinations runs = read_combinations(arguments, scene);
  const std::filesystem::path folder = arguments.output.path;
  const auto path = [&](std::size_t number) { return (folder / run_name(number, runs.size())).string(); };
  const OptionTexts options = arguments.overrides();
  OutputChoice list = arguments.output;
  list.path = (folder / (list.part ? part_ending(*list.part) : "index.csv")).string();
  SharedJob job = sweep_job(shared_run(scene, arguments, runs), list);
  job.jobs = arguments.jobs;
  job.is_whole = [&] { return has_index(list.path, path, scene, runs, options); };
  job.check_more_files = [&] {
    const std::vector<std::size_t> numbers = list.part.value_or(Part{}).pieces(runs.size());
    check_folder(arguments.output.path, list.force, numbers, runs.size());
  };
  job.compute = [&](const std::vector<std::size_t>& numbers, Workers& workers, ProgressBar& progress) {
    arguments.saving.existing = list.existing();
    const auto trace_one = [&](std::size_t number) {
      SweepRow row = run_of_sweep(scene, runs.settings(number), options, path(number), arguments.saving);
      row.run = number + 1;
      row.values = runs.values(number);
      return std::to_string(row.exit_code) + index_line(row);
    };
    return workers.compute(
        {piece_kind, numbers, trace_one}, [&](std::size_t finished, std::size_t, const std::string&) {
          progress.update(static_cast<double>(finished) / static_cast<double>(numbers.size()),
                          static_cast<int>(finished), "runs");
        });
  };
  return carry_out(job, list, team);
}

}  // namespace

SharedJob sweep_of_parts(const SharedRun& run, const OutputChoice& output) {
  SharedJob job = sweep_job(run, output);
  job.compute = [](const std::vector<std::size_t>& numbers, Workers& workers, ProgressBar&) {
    return workers.compute({piece_kind, numbers, {}});
  };
  return job;
}

void add_sweep(CLI::App& program, int& exit_code) {
  const auto [command, arguments] = add_command<SweepArguments>(
      program, exit_code, in_team(run_sweep, together), "sweep",
      "trace a scene for all combinations of values of some parameters, on all cores");
  add_scene(*command, *arguments);
  command
      ->add_option(
          "--vary", arguments->vary,
          "NAME=VALUES: a parameter and its values, as a list 5,10,20 or a range begin:step:end; may "
          "be repeated, the last one changes fastest")
      ->required()
      ->allow_extra_args(false);
  add_output(*command, arguments->output,
             "folder for the loci files and their index (index.csv); default: SCENE_sweep, here");
  add_part(*command, arguments->output);
  command->add_option("--jobs", arguments->jobs, "runs at the same time; 0: one per core")
      ->check(CLI::Range(0, 1024));
  add_output_flags(*command, arguments->output, {.force = "replace existing files of the same runs"});
  add_no_lock(*command, arguments->saving);
  add_trace_options(*command, *arguments);
  command->footer(
      "Example:\n"
      "  eigentrail sweep data/scenes/rotating_mass.toml --vary drag=5,10,20 --vary a_n=500:500:2000 -o "
      "drag");
}

}  // namespace eigentrail::app
