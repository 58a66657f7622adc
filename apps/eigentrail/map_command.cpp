#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "commands.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/stability/stability_map.hpp"
#include "eigentrail/store/map_writer.hpp"
#include "output.hpp"
#include "scene_arguments.hpp"
#include "shared_job.hpp"

namespace eigentrail::app {
namespace {

constexpr std::size_t most_columns = 60;
constexpr std::size_t most_rows = 24;

char symbol(int unstable) {
  if (unstable == MapLine::unknown) return '?';
  if (unstable == 0) return '.';
  return unstable <= 9 ? static_cast<char>('0' + unstable) : '+';
}

/// The cells to show of n, at most `most` and including both ends, in ascending order of their values.
/// `ascending`: whether the values of the cells ascend.
std::vector<std::size_t> shown(std::size_t n, std::size_t most, bool ascending) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < count; ++i) cells.push_back((i * (n - 1) + (count - 1) / 2) / (count - 1));
  if (!ascending) std::reverse(cells.begin(), cells.end());
  return cells;
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

/// The map as lines of text: the second parameter increases upwards, the first to the right, with names and
/// values on the axes. '.': no mode grows; digit: number of growing modes, '+' if more than nine; '?':
/// unknown. Of a large map only some of the cells are shown, at equal distances.
std::vector<std::string> map_picture(const StabilityMap& map, const std::string& first,
                                     const std::string& second) {
  const auto columns = shown(map.first.size(), most_columns, map.first.front() < map.first.back());
  auto rows = shown(map.lines.size(), most_rows, map.lines.front().second < map.lines.back().second);
  std::reverse(rows.begin(), rows.end());
  const auto value_of = [&](std::size_t row) { return rounded(map.lines[row].second, 5); };
  const std::size_t width =
      std::max({second.size(), value_of(rows.front()).size(), value_of(rows.back()).size()});
  std::vector<std::string> text{"  " + padded(second, width)};
  for (const std::size_t row : rows) {
    const bool end = row == rows.front() || row == rows.back();
    std::string line = "  " + padded(end ? value_of(row) : "", width) + " |";
    for (const std::size_t column : columns) line += symbol(map.lines[row].unstable[column]);
    text.push_back(line);
  }
  const std::string left = rounded(map.first[columns.front()], 5);
  const std::string right = rounded(map.first[columns.back()], 5);
  text.push_back("  " + padded("", width) + " +" + std::string(columns.size(), '-'));
  const std::size_t used = left.size() + right.size();
  const std::size_t gap = columns.size() > used + 2 ? columns.size() - used : 2;
  text.push_back("  " + padded("", width) + "  " + left + std::string(gap, ' ') + right + "  " + first);
  return text;
}

struct MapArguments : PlaneArguments {
  OutputChoice output;
  std::string grid = "50";
  MapOptions window;
};

/// Reads "N", or "NxM" for N values of the second parameter and M of the first.
void read_grid(const std::string& text, MapOptions& options) {
  const std::size_t cross = text.find('x');
  const auto second = parsed_number<int>(text.substr(0, cross));
  const auto first = cross == std::string::npos ? second : parsed_number<int>(text.substr(cross + 1));
  if (!second || !first)
    throw InputError(
        "--grid: expected N, or NxM for N values of the second parameter by M of the first; found '" + text +
        "'");
  options.n_second = *second;
  options.n_first = *first;
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
  const auto share = [&](std::size_t part) {
    return percent(static_cast<double>(part) / static_cast<double>(totals.cells), 3);
  };
  std::printf("  stable %s, ", share(totals.stable).c_str());
  if (totals.marginal > 0) std::printf("marginal %s, ", share(totals.marginal).c_str());
  std::printf("unstable %s, unknown %s (%zu of %zu cells)\n", share(totals.unstable).c_str(),
              share(totals.unknown).c_str(), totals.unknown, totals.cells);
  if (least <= largest)
    std::printf("  margin from %s to %s 1/s\n", rounded(least).c_str(), rounded(largest).c_str());
}

void print_work(const StabilityMap& map, const MapTotals& totals, std::optional<double> seconds) {
  Eigen::Index size = 0;
  for (const MapLine& line : map.lines) size = std::max(size, line.n_independent);
  const double cells = static_cast<double>(totals.cells);
  std::printf("  work  %zu traces for %zu cells, %llu complex LU of size %lld: %s per cell\n",
              map.lines.size(), totals.cells, static_cast<unsigned long long>(totals.factorizations),
              static_cast<long long>(size) + 1,
              rounded(static_cast<double>(totals.factorizations) / cells, 3).c_str());
  if (!seconds) return;
  std::printf("  time  %s s: %s ms per cell\n", rounded(*seconds, 3).c_str(),
              rounded(1e3 * *seconds / cells, 3).c_str());
}

void print_summary(const MapSetup& setup, const StabilityMap& map, std::optional<double> seconds) {
  const TraceSetup& trace = setup.trace;
  const MapOptions& options = setup.options;
  const auto window = [&](const std::string& name, double from, double to) {
    const std::string& unit = trace.scene.parameters.at(name).unit;
    return name + " " + exact_text(from) + " -> " + exact_text(to) + (unit.empty() ? "" : " " + unit);
  };
  print_title(trace.scene.title);
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
int finish_map(const MapSetup& setup, const SharedRun& run, const ComputedRun& lines,
               const OutputChoice& output) {
  const StabilityMap map = map_of(setup, lines.pieces);
  const MapTotals totals = total(map);
  if (totals.unknown == totals.cells) {
    std::fprintf(stderr, "eigentrail: %s: %s\n", setup.trace.scene.path.c_str(),
                 printable(failure(map)).c_str());
    return numbers_failed;
  }
  write_result(output, run, map_file(setup, map), [&] { print_summary(setup, map, lines.seconds); });
  return done;
}

SharedRun shared_run(const MapSetup& setup, const MapArguments& arguments) {
  const MapOptions& options = setup.options;
  SharedRun run{"map", setup.trace.scene.path, settings_of(setup.trace.scene),
                static_cast<std::size_t>(options.n_second)};
  run.settings.insert(run.settings.end(), {{"--second", options.second},
                                           {"--second-from", exact_text(options.from)},
                                           {"--second-to", exact_text(options.to)},
                                           {"lines", std::to_string(options.n_second)},
                                           {"cells", std::to_string(options.n_first)}});
  for (const auto& [key, text] : arguments.options) run.settings.emplace_back("option " + key, text);
  return run;
}

SharedJob map_job(std::shared_ptr<const MapSetup> setup, SharedRun run, const OutputChoice& output) {
  SharedJob job{std::move(run), hdf5_format(map_format, "stability map"), setup->options.jobs};
  job.compute = [setup](const std::vector<std::size_t>& numbers, Workers& workers, ProgressBar& progress) {
    return map_lines(*setup, numbers, workers, [&](std::size_t finished) {
      progress.update(static_cast<double>(finished) / static_cast<double>(numbers.size()),
                      static_cast<int>(finished), "lines");
    });
  };
  job.finish = [setup, run = job.run, &output](const ComputedRun& lines) {
    return lines.leads ? finish_map(*setup, run, lines, output) : done;
  };
  return job;
}

int run_map(MapArguments& arguments, Team& team) {
  arguments.output.name_like(arguments.scene, "_map", ".h5");
  read_grid(arguments.grid, arguments.window);
  Scene scene = given_scene(arguments);
  arguments.window.second = arguments.second;
  std::tie(arguments.window.from, arguments.window.to) = arguments.second_range(scene);
  const auto setup = std::make_shared<const MapSetup>(
      prepare_map(std::move(scene), arguments.overrides(), arguments.window));
  warn_of_unused(setup->trace.scene, *setup->trace.model);
  check_map_names(*setup);
  return carry_out(map_job(setup, shared_run(*setup, arguments), arguments.output), arguments.output, team);
}

}  // namespace

SharedJob map_of_parts(const SharedRun& run, const OutputChoice& output) {
  MapOptions options;
  options.second = run.setting("--second").value_or("");
  options.from = number_of(run, "--second-from");
  options.to = number_of(run, "--second-to");
  options.n_second = static_cast<int>(number_of(run, "lines"));
  options.n_first = static_cast<int>(number_of(run, "cells"));
  OptionTexts overrides;
  const std::string prefix = "option ";
  for (const auto& [label, text] : run.settings) {
    if (label.starts_with(prefix)) overrides.emplace_back(label.substr(prefix.size()), text);
  }
  return map_job(std::make_shared<const MapSetup>(read_map_setup(
                     parse_scene(run.setting("scene").value_or(""), run.scene_path), overrides, options)),
                 run, output);
}

void add_map(CLI::App& program, int& exit_code) {
  const auto [command, arguments] =
      add_command<MapArguments>(program, exit_code, in_team(run_map, together), "map",
                                "stability over a window of two parameters: growing modes and margin");
  MapOptions& options = arguments->window;
  add_scene(*command, *arguments);
  add_plane(*command, *arguments);
  command->add_option("--grid", arguments->grid,
                      "N values of both, or NxM: N of the second by M of the first (50)");
  add_output(*command, arguments->output, "map file to write (HDF5); default: SCENE_map.h5, here");
  add_part(*command, arguments->output);
  add_override(*command, *arguments, "parameter", "name of the first parameter: the one that is traced");
  add_override(*command, *arguments, "tolerance", "bound of the relative error of every eigenvalue");
  add_no_certify(*command, *arguments,
                 "no certificate that no modes were exchanged: faster; the counts do not depend on identity");
  command->add_option("--jobs", options.jobs, "threads; 0: one per core");
  add_output_flags(*command, arguments->output);
  command->footer(
      "Example:\n  eigentrail map data/scenes/rotating_mass.toml --second drag --second-from 0.5 "
      "--second-to 20 --grid 40x80 -o drag.h5");
}

}  // namespace eigentrail::app
