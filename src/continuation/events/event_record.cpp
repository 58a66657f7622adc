#include "continuation/events/event_record.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// ds/dh of the mean of s of some eigenvalues of a block, mu = s or 1/s in its chart. The mean of s is not
/// the inverse of the mean of 1/s: where two coincide at an exceptional point, they differ to first order.
Complex mean_slope_of_s(const Track& track, const std::vector<Complex>& roots) {
  if (track.pair.chart == Chart::finite) return mean_slope(track, roots);
  if (roots.size() == 1) return -mean_slope(track, roots) / (roots[0] * roots[0]);
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots);
  if (part.size() < 2) return {NAN, NAN};
  const ComplexMatrix inverse = part[0].inverse();
  return -(inverse * part[1] * inverse).trace() / static_cast<double>(roots.size());
}

/// The point differentiated once with respect to one parameter. Empty if that fails.
std::optional<PathNode> slopes_along(PathProblem problem, const PathPoint& point, int parameter,
                                     RunCounts& counts) {
  problem.order = 0;
  return differentiate_point(problem, point, parameter, counts);
}

}  // namespace

void leave_unknown(const PathProblem& problem, Event& event) {
  const auto count = static_cast<Eigen::Index>(problem.model.description().parameters.size());
  event.sensitivity = ComplexVector::Constant(count, Complex(NAN, NAN));
  event.shift = Vector::Constant(count, NAN);
  for (EventOfCopy& copy : event.copies) {
    copy.sensitivity = event.sensitivity;
    copy.shift = event.shift;
  }
}

Complex mean_slope(const Track& track, const std::vector<Complex>& roots) {
  const std::vector<ComplexMatrix> part = part_series(track.series.Lambda, roots);
  return part.size() < 2 ? Complex(NAN, NAN) : mean_series(part)[1];
}

void keep_shape(const PathNode& node, const Track& track, const std::vector<int>& members, double offset,
                Event& event) {
  const ComplexMatrix Lambda = evaluate_series(track.series.Lambda, offset);
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(Lambda);
  const Eigen::Index nearest = nearest_root(solver.eigenvalues(), track.roots[members.front()]);
  const ComplexVector shape = evaluate_series(track.series.Z, offset) * solver.eigenvectors().col(nearest);
  keep_shape(node, track.pair.part, shape, event);
}

void keep_shape(const PathNode& node, int part, const ComplexVector& shape, Event& event) {
  const SystemMatrix& M = node.linearization.M[0];
  event.shape = normalize_shape(shape, M, {});
  event.copies.assign(static_cast<std::size_t>(n_copies(node.basis, part)), {});
  if (event.copies.empty()) return;
  const ComplexVector z = node.basis.coordinates(shape, part);
  for (std::size_t i = 0; i < event.copies.size(); ++i)
    event.copies[i].shape =
        normalize_shape(node.basis.shapes(z, part, static_cast<int>(i) + 1).col(0), M, {});
}

PathPoint solved_point(const PathProblem& problem, const PathNode& node, RunCounts& counts) {
  if (counts.evaluations.residual.empty()) counts.evaluations = problem.model.new_counts();
  PathPoint point;
  point.p = node.p;
  point.equilibrium = keep_equilibrium(problem.model, node.path.parameters.col(0), node.path.x.col(0),
                                       node.path.lambda.col(0), counts.evaluations);
  point.basis = {{node.basis.T[0]}, node.basis.is_identity, node.basis.parts};
  return point;
}

void keep_sensitivities(const PathProblem& problem, const PathPoint& point, const PathNode& node,
                        const Track& track, const std::vector<int>& members, const Movement& moves,
                        Event& event, RunCounts& counts) {
  const auto& parameters = problem.model.description().parameters;
  leave_unknown(problem, event);
  const std::vector<Complex> roots = roots_of(track, members);
  const double speed = coefficient(node.path.parameters, problem.traced, 1);
  PathPoint of_track = point;
  of_track.pairs = {track.pair};
  const auto keep = [&](ComplexVector& sensitivity, Vector& shift) {
    for (int q = 0; q < static_cast<int>(parameters.size()); ++q) {
      if (parameters[static_cast<std::size_t>(q)].definition) continue;
      if (q == problem.traced) {
        sensitivity[q] = mean_slope_of_s(track, roots) / speed;
        continue;
      }
      const std::optional<PathNode> along = slopes_along(problem, of_track, q, counts);
      if (!along) continue;
      const Track& along_q = along->tracks.front();
      sensitivity[q] = mean_slope_of_s(along_q, roots);
      const double moved = moves ? moves(track, *along, along_q) * speed : NAN;
      if (std::isfinite(moved)) shift[q] = moved;
    }
  };
  keep(event.sensitivity, event.shift);
  // Other parameters may change equal parts differently.
  for (std::size_t i = 0; i < event.copies.size(); ++i) {
    of_track.basis = basis_with_copy(point.basis, track.pair.part, static_cast<int>(i) + 1);
    keep(event.copies[i].sensitivity, event.copies[i].shift);
  }
}

double shift_of_meeting(const Track& along_path, const Track& along_q, EventKind kind,
                        const std::vector<int>& members) {
  if (members.size() != 2) return NAN;
  const std::vector<Complex> roots = roots_of(along_path, members);
  const std::vector<ComplexMatrix> path = part_series(along_path.series.Lambda, roots);
  const std::vector<ComplexMatrix> q = part_series(along_q.series.Lambda, roots);
  if (path.size() < 2 || q.size() < 2) return NAN;
  if (kind == EventKind::collision)
    return -(discriminant_series(q, 1)[1] / discriminant_series(path, 1)[1]).real();
  if (kind != EventKind::crossing) return NAN;
  // A semisimple double eigenvalue: the eigenvalues of the derivative of Lambda along the path are the two
  // slopes, and its eigenvectors are those of the two branches. In them, the diagonal of the derivative with
  // respect to q has the slopes in q.
  const Eigen::ComplexEigenSolver<ComplexMatrix> solver(path[1]);
  const ComplexMatrix along = solver.eigenvectors().inverse() * q[1] * solver.eigenvectors();
  return -((along(0, 0) - along(1, 1)) / (solver.eigenvalues()[0] - solver.eigenvalues()[1])).real();
}

void keep_fold_sensitivities(const PathProblem& problem, const PathNode& node, Event& event,
                             RunCounts& counts) {
  const auto& parameters = problem.model.description().parameters;
  std::vector<int> all(parameters.size());
  for (std::size_t q = 0; q < all.size(); ++q) all[q] = static_cast<int>(q);
  const std::vector<KernelLoad> loads =
      kernel_loads(problem.model, node.path, all, node.linearization, node.basis.T[0], counts.evaluations);
  leave_unknown(problem, event);
  for (const int q : all) {
    const auto i = static_cast<std::size_t>(q);
    if (q == problem.traced || parameters[i].definition) continue;
    event.shift[q] = -loads[i].along_kernel / loads[static_cast<std::size_t>(problem.traced)].along_kernel;
  }
}

}  // namespace eigentrail
