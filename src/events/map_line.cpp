// The cells of one line of a stability map.
#include <algorithm>
#include <cmath>
#include <limits>

#include "eigentrail/events/stability_map.hpp"

namespace eigentrail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A cell this close to a cut, relative to the range, is on it: no closer are events located.
constexpr double on_cut = 1e-9;

/// The trace of a line, and what it tells.
struct LineTrace {
  RecordedPath path;
  std::vector<AxisStretch> stretches;
  EigenvalueAccuracy accuracy;
  std::vector<bool> complete;  ///< per step: no mode is missing that is there on other steps
};

/// Number of eigenvalues that a step follows, both members of a pair. Modes appear and vanish at nodes only.
int eigenvalues_on_step(const RecordedPath& path, std::size_t step) {
  int count = 0;
  for (const Complex s : path.eigenvalues_at({step, 0.5})) {
    if (!std::isnan(s.real())) count += s.imag() != 0.0 ? 2 : 1;
  }
  return count;
}

std::vector<bool> complete_steps(const RecordedPath& path, bool all_followed) {
  std::vector<bool> complete(path.steps.size(), true);
  if (!all_followed) return complete;
  std::vector<int> counts;
  for (std::size_t step = 0; step < path.steps.size(); ++step)
    counts.push_back(eigenvalues_on_step(path, step));
  const int most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  for (std::size_t step = 0; step < counts.size(); ++step) complete[step] = counts[step] == most;
  return complete;
}

/// Least damping ratio of the complex pairs.
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

/// -max Re s with the sign that the stability says.
double margin(const ComplexVector& s, Stability stability) {
  double fastest = -INFINITY;
  for (const Complex value : s) {
    if (std::isfinite(value.real())) fastest = std::max(fastest, value.real());
  }
  if (!std::isfinite(fastest)) return nan;
  if (stability == Stability::marginal) return 0.0;
  return stability == Stability::stable ? std::max(-fastest, 0.0) : std::min(-fastest, 0.0);
}

/// The stretch of a place with `p`; on a cut that of its two with fewer growing modes.
const AxisStretch* stretch_at(const LineTrace& line, const PathPosition& at, double p,
                              const ComplexVector& s) {
  const auto here = std::find_if(line.stretches.begin(), line.stretches.end(),
                                 [&at](const AxisStretch& stretch) { return at <= stretch.to.at; });
  if (here == line.stretches.end()) return nullptr;
  const double near = on_cut * (line.path.highest() - line.path.lowest());
  const PathStep& step = line.path.steps[at.step];
  const auto fewer = [&](const AxisStretch* best, const AxisStretch& other) {
    return count_growing(other, step, s, line.accuracy) < count_growing(*best, step, s, line.accuracy)
               ? &other
               : best;
  };
  const AxisStretch* best = &*here;
  if (here->to.on_axis && std::abs(p - here->to.p) <= near && here + 1 != line.stretches.end())
    best = fewer(best, *(here + 1));
  if (here->from.on_axis && std::abs(p - here->from.p) <= near && here != line.stretches.begin())
    best = fewer(best, *(here - 1));
  return best;
}

void fill_cell(const LineTrace& trace, double p, std::size_t cell, MapLine& line) {
  const std::vector<PathPosition> places = trace.path.positions(p);
  if (places.empty()) return;
  line.turned_back = line.turned_back || places.size() > 1;
  const PathPosition at = places.front();
  if (!trace.complete[at.step]) {
    ++line.doubtful_cells;
    return;
  }
  const ComplexVector s = trace.path.eigenvalues_at(at);
  const AxisStretch* stretch = stretch_at(trace, at, p, s);
  if (stretch == nullptr) return;
  line.unstable[cell] = count_growing(*stretch, trace.path.steps[at.step], s, trace.accuracy);
  line.margin[cell] = margin(s, stretch->stability);
  line.damping_ratio[cell] = least_damping_ratio(s);
  line.marginal_cells += stretch->stability == Stability::marginal ? 1 : 0;
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

MapLine map_line(const MapSetup& setup, double second, const std::vector<double>& first) {
  TraceOptions options = setup.trace.options;
  options.values[setup.options.second] = second;
  PathRecorder recorder;
  TraceObserver observer;
  observer.point = [&recorder](const TracePoint& point) {
    recorder.append(point);
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

  LineTrace traced{recorder.path(), {}, {options.tolerance, result.s_ref}, {}};
  traced.stretches = axis_stretches(traced.path, result.events, traced.accuracy);
  traced.complete = complete_steps(traced.path, result.n_modes == result.n_available);
  for (std::size_t cell = 0; cell < first.size(); ++cell) fill_cell(traced, first[cell], cell, line);
  add_axis_points(traced.stretches, line);
  return line;
}

}  // namespace eigentrail
