// What an event keeps beside its place: the eigenvector, and how it depends on every parameter of the scene.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/normalization.hpp"

namespace eigentrail {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// d/dh of the mean of some eigenvalues of a block, in its chart; NaN where they are not told from the
/// others.
Complex mean_slope(const Track& track, const std::vector<Complex>& roots) {
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots);
  return part.size() < 2 ? Complex(nan, nan) : mean_series(part)[1];
}

/// ds/dh from that of the chart's eigenvalue.
Complex slope_of_s(Complex slope, Complex mu, Chart chart) {
  return chart == Chart::finite ? slope : -slope / (mu * mu);
}

/// All series of a point along one parameter at first order only.
std::optional<PathNode> slopes_along(PathProblem problem, const PathPoint& point, int parameter,
                                     RunCounts& counts) {
  problem.order = 0;
  return differentiate_point(problem, point, parameter, counts);
}

}  // namespace

void Tracer::keep_shape(const PathNode& node, std::size_t track, const std::vector<int>& members,
                        double offset, Event& event) const {
  const Track& there = node.tracks[track];
  const ComplexMatrix Lambda = evaluate_series(there.series.Lambda, offset);
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(Lambda);
  Eigen::Index nearest = 0;
  (solver.eigenvalues().array() - there.roots[members.front()]).abs().minCoeff(&nearest);
  const ComplexVector shape = evaluate_series(there.series.Z, offset) * solver.eigenvectors().col(nearest);
  event.shape = normalize_shape(shape, node.linearization.M[0], {});
}

/// A point of the path as it was before it was differentiated; without modes.
PathPoint Tracer::solved_point(const PathNode& node) {
  PathPoint point;
  point.p = node.p;
  point.equilibrium = keep_equilibrium(problem_.model, node.path.parameters.col(0), node.path.x.col(0),
                                       node.path.lambda.col(0), result_.counts.evaluations);
  point.basis = {{node.basis.T[0]}, node.basis.is_identity};
  return point;
}

void Tracer::keep_sensitivities(const PathPoint& point, const PathNode& node, std::size_t track,
                                const std::vector<int>& members, const Movement& moves, Event& event) {
  const auto& parameters = problem_.model.description().parameters;
  const auto count = static_cast<Eigen::Index>(parameters.size());
  event.sensitivity = ComplexVector::Constant(count, Complex(nan, nan));
  event.shift = Vector::Constant(count, nan);
  const Track& here = node.tracks[track];
  const std::vector<Complex> roots = roots_of(here, members);
  const Complex mu = ComplexVector::Map(roots.data(), static_cast<Eigen::Index>(roots.size())).mean();
  const double speed = coefficient(node.path.parameters, problem_.traced, 1);
  PathPoint of_track = point;
  of_track.pairs = {here.pair};
  for (int q = 0; q < static_cast<int>(count); ++q) {
    if (parameters[static_cast<std::size_t>(q)].definition) continue;
    if (q == problem_.traced) {
      event.sensitivity[q] = slope_of_s(mean_slope(here, roots) / speed, mu, here.pair.chart);
      continue;
    }
    const std::optional<PathNode> along = slopes_along(problem_, of_track, q, result_.counts);
    if (!along) continue;
    event.sensitivity[q] = slope_of_s(mean_slope(along->tracks.front(), roots), mu, here.pair.chart);
    const double shift = moves(here, *along, along->tracks.front()) * speed;
    if (std::isfinite(shift)) event.shift[q] = shift;
  }
}

void Tracer::record_zero(const Closer& closer, const Vector& g, double offset, const Member& member,
                         const Aim& aim, int retrackings) {
  const Track& there = closer.node.tracks.front();
  const Chart chart = there.pair.chart;
  const EventKind asked = aim.criterion.kind;
  const bool located = g.size() > 1;
  const Complex root =
      located ? evaluate_series(ComplexMatrix(closer.series.transpose()), offset)[0] : closer.root;
  Event event;
  event.kind = asked != EventKind::flutter || aim.pair ? asked : EventKind::divergence;
  event.p = evaluate_series(closer.node.path.parameters, offset)[problem_.traced];
  event.s = chart_value(root, chart);
  if (event.kind == EventKind::flutter) event.s = Complex(0.0, std::abs(event.s.imag()));
  if (event.kind == EventKind::divergence) event.s = 0.0;
  event.modes = {node_.tracks[member.track].modes[member.index]};
  event.retrackings = retrackings;
  event.node = result_.nodes;
  if (asked == EventKind::extremum) event.value = -event.s.real() / std::abs(event.s);
  if (asked == EventKind::damping_ratio || asked == EventKind::resonance) event.value = aim.criterion.value;
  if (located) event.direction = direction_of(closer, g, offset, aim);
  // Modes that coalesce leave the imaginary axis, or pass it, at their meeting: one point, one event. In the
  // reciprocal chart zero is infinity.
  const bool met = std::any_of(result_.events.begin(), result_.events.end(), [&](const Event& other) {
    // Around a triple one the roots are known to the cube root of the error only.
    const double near = (other.modes.size() > 2 ? 1e-4 : 1e-6) * range();
    return other.kind == EventKind::collision && (!aim.pair || other.modes.size() > 1) &&
           std::abs(other.p - event.p) <= near;
  });
  if (asked == EventKind::flutter && met) return;
  if (event.kind == EventKind::divergence && chart == Chart::reciprocal) return;
  Eigen::Index nearest = 0;
  (there.roots.array() - closer.root).abs().minCoeff(&nearest);
  const std::vector<int> members{static_cast<int>(nearest)};
  keep_shape(closer.node, 0, members, offset, event);
  const auto moves = [&](const Track&, const PathNode& along, const Track& track) {
    const Complex slope = mean_slope(track, roots_of(there, members));
    const ComplexVector series{{closer.root, slope}};
    const Vector g_q = criterion_series(aim.criterion, series, chart, excitation(along).head(2));
    return located && aim.sought == Sought::zero ? -g_q[1] / g[1] : nan;
  };
  keep_sensitivities(closer.point, closer.node, 0, members, moves, event);
  add_static_event(closer.node, std::move(event));
}

int Tracer::direction_of(const Closer& closer, const Vector& g, double offset, const Aim& aim) const {
  const auto sign = [](double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; };
  double slope = 0.0;
  for (Eigen::Index k = g.size() - 1; k > 0; --k) slope = slope * offset + static_cast<double>(k) * g[k];
  switch (aim.sought) {
    case Sought::zero:
      return sign(slope * coefficient(closer.node.path.parameters, problem_.traced, 1));
    case Sought::extremum:
      return -sign(g[2]);  // least damping is where Re mu / |mu| is largest
    default:
      return 0;
  }
}

/// How eigenvalues of one block that meet move their meeting.
double Tracer::shift_of_meeting(const Track& along_path, const Track& along_q, EventKind kind,
                                const std::vector<int>& members) {
  if (members.size() != 2) return nan;
  const std::vector<Complex> roots = roots_of(along_path, members);
  const std::vector<ComplexMatrix> path = part_series(along_path.series.Lambda, roots);
  const std::vector<ComplexMatrix> q = part_series(along_q.series.Lambda, roots);
  if (path.size() < 2 || q.size() < 2) return nan;
  if (kind == EventKind::collision) return -(gap_series(q, 1)[1] / gap_series(path, 1)[1]).real();
  if (kind != EventKind::crossing) return nan;
  // Semisimple: to first order each eigenvalue goes on along its own vector.
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(path[1]);
  const ComplexMatrix along = solver.eigenvectors().inverse() * q[1] * solver.eigenvectors();
  return -((along(0, 0) - along(1, 1)) / (solver.eigenvalues()[0] - solver.eigenvalues()[1])).real();
}

void Tracer::keep_fold_sensitivities(const PathNode& node, Event& event) {
  const auto& parameters = problem_.model.description().parameters;
  std::vector<int> all(parameters.size());
  for (std::size_t q = 0; q < all.size(); ++q) all[q] = static_cast<int>(q);
  const std::vector<KernelLoad> loads = kernel_loads(problem_.model, node.path, all, node.linearization,
                                                     node.basis.T[0], result_.counts.evaluations);
  const auto count = static_cast<Eigen::Index>(all.size());
  event.sensitivity = ComplexVector::Constant(count, Complex(nan, nan));
  event.shift = Vector::Constant(count, nan);
  for (const int q : all) {
    const auto i = static_cast<std::size_t>(q);
    if (q == problem_.traced || parameters[i].definition) continue;
    event.shift[q] = -loads[i].along_kernel / loads[static_cast<std::size_t>(problem_.traced)].along_kernel;
  }
}

}  // namespace eigentrail
