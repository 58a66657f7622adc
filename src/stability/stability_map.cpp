#include "eigentrail/stability/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/archived_parts.hpp"
#include "core/reciprocal_condition.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/projection/project.hpp"
#include "stability/axis_samples.hpp"
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

/// The checked options, without the model. Adds the parameters that the options use to `used`.
MapSetup checked_setup(Scene scene, const OptionTexts& overrides, const MapOptions& options,
                       std::set<int>& used) {
  MapSetup setup{{std::move(scene), {}, nullptr}, options};
  setup.trace.options = read_trace_options(setup.trace.scene, overrides, used);
  check_options(options, setup.trace.options, setup.trace.scene);
  return setup;
}

std::vector<double> first_values(const MapSetup& setup) {
  return evenly(setup.trace.options.from, setup.trace.options.to, setup.options.n_first);
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A cell closer to a cut than this, relative to the range, is on it: the accuracy of located events.
constexpr double on_cut = 1e-9;

/// The trace of a line with its stretches of constant stability.
struct LineTrace {
  RecordedPath path;
  std::vector<AxisStretch> stretches;
  Judging judging;
  std::vector<bool> complete;  ///< per step: whether all modes are followed
};

/// Bounds of a number of eigenvalues.
struct EigenvalueCount {
  int least = 0, most = 0;
};

/// Bounds of the number of eigenvalues that a step follows, both members of complex pairs counted. Close to
/// the real axis rounding may turn a pair into a real eigenvalue or the reverse, so a mode there counts as
/// one or two. The middle of the step is representative: modes appear and vanish at nodes only.
EigenvalueCount eigenvalues_on_step(const RecordedPath& path, std::size_t step, double reference) {
  constexpr double beside_real_axis = 1e-3;
  EigenvalueCount count;
  for (const Complex s : path.eigenvalues_at({step, 0.5})) {
    if (std::isnan(s.real())) continue;
    count.least += std::abs(s.imag()) > beside_real_axis * std::max(std::abs(s), reference) ? 2 : 1;
    count.most += s.imag() != 0.0 ? 2 : 1;
  }
  return count;
}

/// Number of eigenvalues of the pencil, those of copies of its parts included: twice its size; 0 (unknown) if
/// the mass matrix is singular.
int expected_eigenvalues(const ReducedPencil& pencil) {
  constexpr double singular = 1e-12;
  const Matrix& M = pencil.M[0];
  if (!(reciprocal_condition(M.partialPivLu()) > singular)) return 0;
  auto freedoms = static_cast<int>(M.rows()) * (1 + pencil.copies);
  for (const ReducedPencil& part : pencil.parts) freedoms += static_cast<int>(part.size()) * part.copies;
  return 2 * freedoms;
}

/// Per step: whether it follows as many eigenvalues as its ends have (`expected`, per node). If that is
/// unknown (0): whether it follows as many as any other step.
std::vector<bool> complete_steps(const RecordedPath& path, const std::vector<int>& expected,
                                 double reference) {
  std::vector<EigenvalueCount> counts;
  int seen = 0;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    counts.push_back(eigenvalues_on_step(path, step, reference));
    seen = std::max(seen, counts.back().least);
  }
  std::vector<bool> complete;
  for (std::size_t step = 0; step < counts.size(); ++step) {
    const int needed = std::max(expected[step], expected[step + 1]);
    const EigenvalueCount& count = counts[step];
    complete.push_back(needed > 0 ? count.least <= needed && needed <= count.most : count.most >= seen);
  }
  return complete;
}

/// Least damping ratio of the complex pairs; NaN if there are none.
double least_damping_ratio(const ComplexVector& s) {
  double least = nan;
  for (const Complex value : s) {
    const double size = std::abs(value);
    if (!std::isfinite(size) || value.imag() == 0.0) continue;
    const double ratio = -value.real() / size;
    if (!(ratio >= least)) least = ratio;
  }
  return least;
}

/// -max Re s, set to zero where its sign contradicts the stability; zero if marginal, NaN without
/// eigenvalues.
double margin(const ComplexVector& s, Stability stability) {
  double fastest = -INFINITY;
  for (const Complex value : s) {
    if (std::isfinite(value.real())) fastest = std::max(fastest, value.real());
  }
  if (!std::isfinite(fastest)) return nan;
  if (stability == Stability::marginal) return 0.0;
  return stability == Stability::stable ? std::max(0.0, -fastest) : std::min(0.0, -fastest);
}

/// The stretch of a sample at the parameter value `p`. On a cut: the one of its two stretches that has fewer
/// growing modes.
const AxisStretch* stretch_at(const LineTrace& line, const AxisSample& sample, double p) {
  const auto here = std::find_if(line.stretches.begin(), line.stretches.end(),
                                 [&](const AxisStretch& stretch) { return sample.at <= stretch.to.at; });
  if (here == line.stretches.end()) return nullptr;
  const double near = on_cut * (line.path.highest() - line.path.lowest());
  const auto fewer = [&](const AxisStretch* best, const AxisStretch& other) {
    return count_growing(other, sample) < count_growing(*best, sample) ? &other : best;
  };
  const AxisStretch* best = &*here;
  if (here->to.on_axis && std::abs(p - here->to.p) <= near && here + 1 != line.stretches.end())
    best = fewer(best, *(here + 1));
  if (here->from.on_axis && std::abs(p - here->from.p) <= near && here != line.stretches.begin())
    best = fewer(best, *(here - 1));
  return best;
}

/// Evaluates the cell at `p`. It stays unknown if the path does not pass `p` or lacks a mode there.
void fill_cell(const LineTrace& trace, double p, std::size_t cell, MapLine& line) {
  const std::vector<PathPosition> places = trace.path.positions(p);
  if (places.empty()) return;
  const PathPosition at = places.front();
  if (!trace.complete[at.step]) {
    ++line.doubtful_cells;
    return;
  }
  const AxisSample sample = axis_sample(trace.path, at, trace.judging);
  const AxisStretch* stretch = stretch_at(trace, sample, p);
  if (stretch == nullptr) return;
  const ComplexVector s = trace.path.eigenvalues_at(at);
  line.unstable[cell] = count_growing(*stretch, sample);
  line.margin[cell] = margin(s, stretch->stability);
  line.damping_ratio[cell] = least_damping_ratio(s);
  line.marginal_cells += stretch->stability == Stability::marginal ? 1 : 0;
  line.partial_cells += stretch->stability != Stability::unstable && !stretch->whole ? 1 : 0;
}

bool turns_back(const std::vector<double>& p) {
  return !std::is_sorted(p.begin(), p.end()) && !std::is_sorted(p.rbegin(), p.rend());
}

void add_axis_points(const std::vector<AxisStretch>& stretches, MapLine& line) {
  const auto add = [&line](const AxisCut& cut) {
    if (cut.on_axis)
      line.axis_points.push_back({cut.p, cut.cause, cut.cause == "infinity" ? nan : cut.s.imag()});
  };
  for (const AxisStretch& stretch : stretches) add(stretch.from);
  if (!stretches.empty()) add(stretches.back().to);
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
  const auto note = [&](const std::string& what, bool with_reason, bool (*applies)(const MapLine&)) {
    const auto first = std::find_if(map.lines.begin(), map.lines.end(), applies);
    const auto count = std::count_if(map.lines.begin(), map.lines.end(), applies);
    if (count == 0) return;
    notes.push_back(std::to_string(count) + " of " + std::to_string(map.lines.size()) + " lines " + what +
                    ", first at " + second + " = " + short_text(first->second, 6) +
                    (with_reason ? ": " + first->message : ""));
  };
  note("could not be begun; their cells are unknown", true,
       [](const MapLine& line) { return !has_started(line.status); });
  note("ended early; cells beyond are unknown", true,
       [](const MapLine& line) { return has_started(line.status) && line.status != TraceStatus::completed; });
  note("miss a mode somewhere; their cells there are unknown", false,
       [](const MapLine& line) { return line.doubtful_cells > 0; });
  note("turn back at a fold; their cells show the first passage", false,
       [](const MapLine& line) { return line.turned_back; });
  note("are stable among the followed modes; others are not known", false,
       [](const MapLine& line) { return line.partial_cells > 0; });
  return notes;
}

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

MapLine map_line(const MapSetup& setup, double second, const std::vector<double>& first) {
  TraceOptions options = setup.trace.options;
  options.values[setup.options.second] = second;
  options.events = {.veerings = false, .other_paths = false};  // cells need changes of stability only
  PathRecorder recorder;
  std::vector<int> expected;
  TraceObserver observer;
  observer.point = [&](const TracePoint& point) {
    recorder.append(point);
    expected.push_back(expected_eigenvalues(point.node.pencil));
    return true;
  };
  const TraceResult result = trace(*setup.trace.model, options, observer);

  MapLine line;
  line.second = second;
  line.unstable.assign(first.size(), MapLine::unknown);
  line.margin.assign(first.size(), nan);
  line.damping_ratio.assign(first.size(), nan);
  line.status = result.status;
  line.message = result.message;
  line.reached = has_started(result.status) ? result.reached : nan;
  line.n_modes = result.n_modes;
  line.n_available = result.n_available;
  line.n_independent = result.n_independent;
  line.counts = result.counts;

  const EigenvalueAccuracy accuracy{options.tolerance, result.s_ref};
  LineTrace traced{recorder.path(), {}, {}, {}};
  traced.judging = {accuracy, permanence_of_modes(traced.path, accuracy)};
  traced.stretches = axis_stretches(traced.path, result.events, accuracy);
  const bool all_followed = result.n_modes == result.n_available;
  traced.complete = all_followed ? complete_steps(traced.path, expected, result.s_ref)
                                 : std::vector<bool>(traced.path.steps.size(), true);
  line.turned_back = turns_back(traced.path.p);
  for (std::size_t cell = 0; cell < first.size(); ++cell) fill_cell(traced, first[cell], cell, line);
  add_axis_points(traced.stretches, line);
  return line;
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
