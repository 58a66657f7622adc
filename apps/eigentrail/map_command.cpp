#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "check_output.hpp"
#include "commands.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "map_picture.hpp"
#include "output.hpp"
#include "parts.hpp"
#include "progress_bar.hpp"
#include "scene_arguments.hpp"
#include "values.hpp"

namespace eigentrail::app {
namespace {

struct MapArguments : SceneArguments {
  OutputChoice output;
  std::optional<Part> part;
  std::string from, to;  ///< of the second parameter
  std::string grid = "50";
  MapOptions options;
  std::map<std::string, std::string> trace_options;  ///< overrides of the scene's [trace]
};

/// Reads "N", or "NxM" for N values of the second parameter and M of the first.
void read_grid(const std::string& text, MapOptions& options) {
  const auto number = [&text](std::size_t begin, std::size_t end) {
    int value = 0;
    const auto parsed = std::from_chars(text.data() + begin, text.data() + end, value);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + end) {
      throw InputError(
          "--grid: expected N, or NxM for N values of the second parameter by M of the first; found '" +
          text + "'");
    }
    return value;
  };
  const std::size_t cross = text.find('x');
  options.n_second = number(0, std::min(cross, text.size()));
  options.n_first = cross == std::string::npos ? options.n_second : number(cross + 1, text.size());
}

std::string percent(std::size_t part, std::size_t whole) {
  return rounded(100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) + " %";
}

void print_shares(const StabilityMap& map, const MapTotals& totals) {
  double least = INFINITY, largest = -INFINITY;
  for (const MapLine& line : map.lines) {
    for (const double margin : line.margin) {
      if (std::isnan(margin)) continue;
      least = std::min(least, margin);
      largest = std::max(largest, margin);
    }
  }
  std::printf("  stable %s, ", percent(totals.stable, totals.cells).c_str());
  if (totals.marginal > 0) std::printf("marginal %s, ", percent(totals.marginal, totals.cells).c_str());
  std::printf("unstable %s, unknown %s (%zu of %zu cells)\n", percent(totals.unstable, totals.cells).c_str(),
              percent(totals.unknown, totals.cells).c_str(), totals.unknown, totals.cells);
  if (least <= largest)
    std::printf("  margin from %s to %s 1/s\n", rounded(least).c_str(), rounded(largest).c_str());
}

/// Cost of a QZ in units of one complex LU. A complex LU of size n + 1 takes 8/3 n^3 operations, QZ without
/// vectors on the companion form of size 2n takes 30 (2n)^3 (Golub and Van Loan, section 7.7).
constexpr int lu_per_qz = 90;

/// `seconds`: wall time; NaN if it is not known.
void print_work(const StabilityMap& map, const MapTotals& totals, double seconds) {
  Eigen::Index size = 0;
  for (const MapLine& line : map.lines) size = std::max(size, line.n_independent);
  const double cells = static_cast<double>(totals.cells);
  std::printf(
      "  work  %zu traces for %zu cells, %llu complex LU of size %lld: %s per cell (a QZ in every cell: "
      "about %d)\n",
      map.lines.size(), totals.cells, static_cast<unsigned long long>(totals.factorizations),
      static_cast<long long>(size) + 1,
      rounded(static_cast<double>(totals.factorizations) / cells, 3).c_str(), lu_per_qz);
  if (std::isnan(seconds)) return;
  std::printf("  time  %s s: %s ms per cell\n", rounded(seconds, 3).c_str(),
              rounded(1e3 * seconds / cells, 3).c_str());
}

void print_summary(const MapSetup& setup, const StabilityMap& map, double seconds) {
  const TraceSetup& trace = setup.trace;
  const MapOptions& options = setup.options;
  const auto window = [&](const std::string& name, double from, double to) {
    const std::string& unit = trace.scene.parameters.at(name).unit;
    return name + " " + exact_text(from) + " -> " + exact_text(to) + (unit.empty() ? "" : " " + unit);
  };
  if (!trace.scene.title.empty()) std::printf("%s\n", printable(trace.scene.title).c_str());
  std::printf("  %d x %d cells: %s, %s, tolerance %s\n", options.n_second, options.n_first,
              window(options.second, options.from, options.to).c_str(),
              window(trace.options.parameter, trace.options.from, trace.options.to).c_str(),
              exact_text(trace.options.tolerance).c_str());
  for (const std::string& line : map_picture(map, trace.options.parameter, options.second))
    std::printf("%s\n", line.c_str());
  std::printf("  . no mode grows, 1 2 ... growing modes, ? unknown\n");
  const MapTotals totals = total(map);
  print_shares(map, totals);
  for (const std::string& note : notes_on(map, options.second))
    std::printf("  note  %s\n", printable(note).c_str());
  print_work(map, totals, seconds);
}

/// The error message for a map in which all cells are unknown.
std::string failure(const StabilityMap& map) {
  const std::string& message = map.lines.front().message;
  return "no cell of the window is known, nothing is written; its first line: " +
         (message.empty() ? "the trace missed a mode" : message);
}

/// Writes the map of lines that have all been computed, and prints its summary.
int finish_map(const MapSetup& setup, const SharedRun& run, const std::vector<std::string>& lines,
               const OutputChoice& output, double seconds) {
  const StabilityMap map = map_of(setup, lines);
  const MapTotals totals = total(map);
  if (totals.unknown == totals.cells) {
    std::fprintf(stderr, "eigentrail: %s: %s\n", setup.trace.scene.path.c_str(),
                 printable(failure(map)).c_str());
    return numbers_failed;
  }
  write_durably(output.path, {map_file(setup, map), run_mark(run)}, existing(output.force));
  if (!output.quiet) {
    print_summary(setup, map, seconds);
    std::printf("wrote %s\n", output.path.c_str());
  }
  return done;
}

SharedRun shared_run(const MapSetup& setup, const MapArguments& arguments) {
  const MapOptions& options = setup.options;
  SharedRun run{"map", setup.trace.scene.path, settings_of(setup.trace.scene),
                static_cast<std::size_t>(options.n_second)};
  run.settings.insert(run.settings.end(), {{"--second", options.second},
                                           {"--from", exact_text(options.from)},
                                           {"--to", exact_text(options.to)},
                                           {"lines", std::to_string(options.n_second)},
                                           {"cells", std::to_string(options.n_first)}});
  for (const auto& [key, text] : arguments.trace_options) run.settings.emplace_back("option " + key, text);
  return run;
}

void check_map_output(const OutputChoice& output) {
  check_output(output.path, output.force, {map_format, "stability map"});
  check_can_create(output.path);
}

int run_map(MapArguments& arguments, Team& team) {
  read_grid(arguments.grid, arguments.options);
  Scene scene = given_scene(arguments);
  const auto index = scene.parameters.index(arguments.options.second);
  const Parameter second = index ? scene.parameters[static_cast<std::size_t>(*index)] : Parameter{};
  arguments.options.from = read_value("--from", arguments.from, second);
  arguments.options.to = read_value("--to", arguments.to, second);
  const MapSetup setup = prepare_map(
      std::move(scene), {arguments.trace_options.begin(), arguments.trace_options.end()}, arguments.options);
  warn_of_unused(setup.trace.scene, *setup.trace.model);
  check_map_names(setup);
  const SharedRun run = shared_run(setup, arguments);
  if (has_ended(arguments.output, team, run, arguments.part)) return done;
  const auto unfinished = unfinished_run(arguments.output, run, arguments.part, team);
  if (team.leads()) arguments.part ? check_part_output(arguments.output) : check_map_output(arguments.output);
  SavingWorkers workers(team.workers(setup.options.jobs), *unfinished);
  const std::vector<std::size_t> numbers =
      arguments.part.value_or(Part{}).pieces(static_cast<std::size_t>(setup.options.n_second));
  ProgressBar progress(arguments.output.quiet);
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::string> lines = map_lines(setup, numbers, workers, [&](std::size_t finished) {
    progress.update(static_cast<double>(finished) / static_cast<double>(numbers.size()),
                    static_cast<int>(finished), "lines");
  });
  progress.finish();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!team.leads()) return done;
  return end_run(*unfinished, [&] {
    if (arguments.part) return write_part(arguments.output, run, *arguments.part, std::move(lines));
    return finish_map(setup, run, lines, arguments.output, seconds);
  });
}

}  // namespace

int merge_map(const SharedRun& run, const std::vector<std::string>& pieces, const OutputChoice& output,
              Team& team) {
  if (!team.leads()) return done;
  MapOptions options;
  options.second = run.setting("--second").value_or("");
  options.from = number_of(run, "--from");
  options.to = number_of(run, "--to");
  options.n_second = static_cast<int>(number_of(run, "lines"));
  options.n_first = static_cast<int>(number_of(run, "cells"));
  OptionTexts overrides;
  const std::string prefix = "option ";
  for (const auto& [label, text] : run.settings) {
    if (label.starts_with(prefix)) overrides.emplace_back(label.substr(prefix.size()), text);
  }
  const MapSetup setup =
      read_map_setup(parse_scene(run.setting("scene").value_or(""), run.scene_path), overrides, options);
  check_map_output(output);
  return finish_map(setup, run, pieces, output, std::nan(""));
}

void add_map(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<MapArguments>();
  CLI::App* command =
      program.add_subcommand("map", "stability over a window of two parameters: growing modes and margin");
  MapOptions& options = arguments->options;
  add_scene(*command, *arguments);
  command->add_option("--second", options.second, "name of the second parameter")->required();
  command->add_option("--from", arguments->from, "first value of the second parameter, in its unit")
      ->required();
  command->add_option("--to", arguments->to, "last value of the second parameter")->required();
  command->add_option("--grid", arguments->grid,
                      "N values of both, or NxM: N of the second by M of the first (50)");
  auto* output = command->add_option("-o,--output", arguments->output.path,
                                     "map file to write (HDF5); default: SCENE_map.h5, here");
  add_part(*command, arguments->part);
  for (const auto& [flag, key, help] :
       {std::array{"--parameter", "parameter", "name of the first parameter: the one that is traced"},
        std::array{"--first-from", "from", "where the window of the first parameter begins"},
        std::array{"--first-to", "to", "where it ends"},
        std::array{"--tolerance", "tolerance", "bound of the relative error of every eigenvalue"}}) {
    command->add_option_function<std::string>(
        flag,
        [arguments, key = std::string(key)](const std::string& text) {
          arguments->trace_options[key] = text;
        },
        std::string(help) + " (overrides the scene)");
  }
  command->add_flag_callback(
      "--no-certify", [arguments] { arguments->trace_options["certify"] = "false"; },
      "no certificate that no modes were exchanged: faster; the counts do not depend on identity");
  command->add_option("--jobs", options.jobs, "threads; 0: one per core");
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n  eigentrail map data/scenes/rotating_mass.toml --second drag --from 0.5 --to 20 --grid "
      "40x80 -o "
      "drag.h5");
  command->callback([arguments, output, &exit_code] {
    if (output->count() == 0)
      arguments->output.path = default_output(arguments->scene, "_map", arguments->part);
    exit_code = together([&](Team& team) { return run_map(*arguments, team); });
  });
}

}  // namespace eigentrail::app
