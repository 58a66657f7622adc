// Computes the cells of one line of a stability map.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/reciprocal_condition.hpp"
#include "eigentrail/stability/stability_map.hpp"

namespace eigentrail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A cell closer to a cut than this, relative to the range, is on it: the accuracy of located events.
constexpr double on_cut = 1e-9;

/// The trace of a line with its stretches of constant stability.
struct LineTrace {
  RecordedPath path;
  std::vector<AxisStretch> stretches;
  EigenvalueAccuracy accuracy;
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

/// The stretch of a place with the parameter value `p`. On a cut: the one of its two stretches that has fewer
/// growing modes.
const AxisStretch* stretch_at(const LineTrace& line, const PathPosition& at, double p,
                              const ComplexVector& s) {
  const auto here = std::find_if(line.stretches.begin(), line.stretches.end(),
                                 [&at](const AxisStretch& stretch) { return at <= stretch.to.at; });
  if (here == line.stretches.end()) return nullptr;
  const double near = on_cut * (line.path.highest() - line.path.lowest());
  const auto growing = [&](const AxisStretch& stretch) {
    return count_growing(line.path, stretch, at, s, line.accuracy);
  };
  const auto fewer = [&](const AxisStretch* best, const AxisStretch& other) {
    return growing(other) < growing(*best) ? &other : best;
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
  const ComplexVector s = trace.path.eigenvalues_at(at);
  const AxisStretch* stretch = stretch_at(trace, at, p, s);
  if (stretch == nullptr) return;
  line.unstable[cell] = count_growing(trace.path, *stretch, at, s, trace.accuracy);
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

  LineTrace traced{recorder.path(), {}, {options.tolerance, result.s_ref}, {}};
  traced.stretches = axis_stretches(traced.path, result.events, traced.accuracy);
  const bool all_followed = result.n_modes == result.n_available;
  traced.complete = all_followed ? complete_steps(traced.path, expected, result.s_ref)
                                 : std::vector<bool>(traced.path.steps.size(), true);
  line.turned_back = turns_back(traced.path.p);
  for (std::size_t cell = 0; cell < first.size(); ++cell) fill_cell(traced, first[cell], cell, line);
  add_axis_points(traced.stretches, line);
  return line;
}

}  // namespace eigentrail
