#include "eigentrail/stability/stability_map.hpp"
#include "eigentrail/projection/project.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/archived_parts.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "stability/second_parameter.hpp"

namespace eigentrail {
namespace {

/// Number of values of each parameter at which the model is checked.
constexpr int checked_per_side = 17;

void check_options(const MapOptions& options, const TraceOptions& trace, const Scene& scene) {
  const auto require = [](bool holds, const std::string& message) {
    if (!holds) throw InputError(message);
  };
  check_second_parameter(scene, options.second, trace.parameter);
  check_second_range(options.from, options.to);
  const std::string grid = std::to_string(options.n_second) + "x" + std::to_string(options.n_first);
  require(options.n_first >= 2 && options.n_second >= 2,
          "--grid: expected at least 2 values of each parameter, found " + grid);
  require(static_cast<long>(options.n_second) * options.n_first <= most_map_cells,
          "--grid: expected at most " + std::to_string(most_map_cells) + " cells, found " + grid);
  require(
      options.jobs >= 0 && options.jobs <= most_map_jobs,
      "--jobs: expected 0 to " + std::to_string(most_map_jobs) + ", found " + std::to_string(options.jobs));
}

std::vector<double> first_values(const MapSetup& setup) {
  return evenly(setup.trace.options.from, setup.trace.options.to, setup.options.n_first);
}

}  // namespace

// How a line is written to an archive and read from it (core/archive.hpp).

Members<3> archived(const AxisPoint*);
Members<16> archived(const MapLine*);

std::uint64_t MapLine::factorizations() const {
  return counts.modes.factorizations + counts.certificate_factorizations + counts.event_factorizations;
}

MapTotals total(const StabilityMap& map) {
  MapTotals totals;
  for (const MapLine& line : map.lines) {
    const auto count = [&line](int value) {
      return static_cast<std::size_t>(std::count(line.unstable.begin(), line.unstable.end(), value));
    };
    const std::size_t marginal = static_cast<std::size_t>(line.marginal_cells);
    const std::size_t unknown = count(MapLine::unknown);
    const std::size_t calm = count(0);
    totals.cells += line.unstable.size();
    totals.unknown += unknown;
    totals.marginal += marginal;
    totals.stable += calm - marginal;
    totals.unstable += line.unstable.size() - calm - unknown;
    totals.factorizations += line.factorizations();
    totals.spectra += line.counts.spectra;
  }
  return totals;
}

std::vector<std::string> notes_on(const StabilityMap& map, const std::string& second) {
  std::vector<std::string> notes;
  const auto note = [&](const std::string& what, auto&& applies, bool with_reason) {
    const auto first = std::find_if(map.lines.begin(), map.lines.end(), applies);
    const auto count = std::count_if(map.lines.begin(), map.lines.end(), applies);
    if (count == 0) return;
    notes.push_back(std::to_string(count) + " of " + std::to_string(map.lines.size()) + " lines " + what +
                    ", first at " + second + " = " + short_text(first->second, 6) +
                    (with_reason ? ": " + first->message : ""));
  };
  note(
      "could not be begun; their cells are unknown",
      [](const MapLine& line) { return !has_started(line.status); }, true);
  note(
      "ended early; cells beyond are unknown",
      [](const MapLine& line) { return has_started(line.status) && line.status != TraceStatus::completed; },
      true);
  note(
      "miss a mode somewhere; their cells there are unknown",
      [](const MapLine& line) { return line.doubtful_cells > 0; }, false);
  note(
      "turn back at a fold; their cells show the first passage",
      [](const MapLine& line) { return line.turned_back; }, false);
  note(
      "are stable among the followed modes; others are not known",
      [](const MapLine& line) { return line.partial_cells > 0; }, false);
  return notes;
}

namespace {

/// The checked options, without the model. Adds the parameters that the options use to `used`.
MapSetup checked_setup(Scene scene, const OptionTexts& overrides, const MapOptions& options,
                       std::set<int>& used) {
  MapSetup setup{{std::move(scene), {}, nullptr}, options};
  setup.trace.options = read_trace_options(setup.trace.scene, overrides, used);
  check_options(options, setup.trace.options, setup.trace.scene);
  return setup;
}

}  // namespace

MapSetup read_map_setup(Scene scene, const OptionTexts& overrides, const MapOptions& options) {
  std::set<int> used;
  return checked_setup(std::move(scene), overrides, options, used);
}

MapSetup prepare_map(Scene scene, const OptionTexts& overrides, const MapOptions& options) {
  check_top_level(scene);
  require_first_range(scene, overrides);
  std::set<int> used;
  MapSetup setup = checked_setup(std::move(scene), overrides, options, used);
  TraceSetup& trace = setup.trace;
  trace.model = model_over_window(trace.scene, trace.options, {options.second, options.from, options.to},
                                  used, checked_per_side);
  project_if_large(trace.model, trace.options,
                   lines_over(trace.options, options.second, options.from, options.to));
  return setup;
}

std::vector<std::string> map_lines(const MapSetup& setup, const std::vector<std::size_t>& numbers,
                                   Workers& workers, const std::function<void(std::size_t)>& finished) {
  const MapOptions& options = setup.options;
  const std::vector<double> first = first_values(setup);
  const std::vector<double> seconds = evenly(options.from, options.to, options.n_second);
  return workers.compute(
      {"line", numbers, [&](std::size_t line) { return packed(map_line(setup, seconds[line], first)); }},
      [&finished](std::size_t done, std::size_t, const std::string&) { finished(done); });
}

StabilityMap map_of(const MapSetup& setup, const std::vector<std::string>& lines) try {
  StabilityMap map;
  map.first = first_values(setup);
  for (const std::string& bytes : lines) {
    MapLine& line = map.lines.emplace_back();
    unpack(bytes, line);
    if (line.unstable.size() != map.first.size() || line.margin.size() != map.first.size() ||
        line.damping_ratio.size() != map.first.size())
      throw ArchiveError("another number of cells");
  }
  return map;
} catch (const ArchiveError& error) {
  throw InputError(std::string("a line of the map is damaged: ") + error.what());
}

StabilityMap stability_map(const MapSetup& setup, const std::function<void(int)>& done) {
  const std::vector<std::size_t> numbers = numbers_to(static_cast<std::size_t>(setup.options.n_second));
  Threads threads(setup.options.jobs);
  return map_of(setup, map_lines(setup, numbers, threads,
                                 [&done](std::size_t lines) { done(static_cast<int>(lines)); }));
}

}  // namespace eigentrail
