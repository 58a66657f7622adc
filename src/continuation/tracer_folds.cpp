// Where the equilibrium path bends back or meets another one.
#include <array>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"

namespace eigentrail {
namespace {

/// Share of the parameter's force in the kernel of a singular stiffness below which another path crosses.
constexpr double branch_point_share = 1e-3;
constexpr double on_fold = 1e-9;  ///< a point that is nearer to a fold than this lies on it

}  // namespace

bool Tracer::reached_end(const PathNode& node) const {
  if (!plane_) return node.p == options_.to;
  const bool outward = heading(node, 1.0) * (options_.to - options_.from) > 0.0;
  return node.p == options_.to || (node.p == options_.from && !outward);
}

double Tracer::remaining() const {
  const double to_branch_point = distance_to_branch_point();
  return plane_ ? to_branch_point : std::min(to_branch_point, std::abs(options_.to - node_.p));
}

/// One length for the whole path: the largest position so far, which may pass zero later.
PathScales Tracer::path_scales() {
  largest_position_ = std::max(largest_position_, node_.path.x.col(0).norm());
  return {largest_position_ > 0.0 ? largest_position_ : 1.0, range()};
}

/// Where the equilibrium's series falls faster along the path than in p, the path is bending back: a fold.
bool Tracer::turn_to_plane(double h) {
  if (plane_ || problem_.structure.fixed_equilibrium || problem_.structure.known_equilibrium) return false;
  if (bridge_ && bridge_->covers(node_.p)) return false;
  const auto plane = plane_along(node_.path, problem_.traced, path_scales(), direction_);
  Path turned = node_.path;
  reparametrize(turned, plane, problem_.traced);
  if (!falls_faster(turned, node_.path, problem_.traced, path_scales(), h)) return false;
  plane_ = plane;
  bridge_.reset();
  direction_ = 1.0;
  turned_step_ = std::abs(h / coefficient(turned.parameters, problem_.traced, 1));
  reparametrize(node_, plane, problem_.traced);
  ++result_.regroupings.planes;
  return true;
}

/// A plane that the path meets at a slant is replaced by one across it.
void Tracer::renew_plane() {
  if (!plane_ || slant(*plane_, node_.path, problem_.traced, path_scales()) > 0.7) return;
  if (bridge_ && bridge_->covers(coordinate(node_.path.x.col(0), node_.p))) return;
  bridge_.reset();
  plane_ = plane_along(node_.path, problem_.traced, path_scales(), 1.0);
  reparametrize(node_, *plane_, problem_.traced);
  ++result_.regroupings.planes;
}

/// In the path's own coordinate the end of the range lies where p says so.
bool Tracer::land_on_end(double& h, std::optional<PathNode>& next) {
  if (!plane_) return true;
  for (const double end : {options_.to, options_.from}) {
    const double side = end == options_.to ? options_.to - options_.from : options_.from - options_.to;
    if ((next->p - end) * side <= 0.0 || next->p == end) continue;
    // Newton for p(h) = end from inside the step.
    double distance = h * (end - node_.p) / (next->p - node_.p);
    for (int i = 0; i < most_retrackings; ++i) {
      if (attempt(distance, next)) return false;
      const double miss = end - next->p;
      if (std::abs(miss) <= 1e-14 * std::max(range(), std::abs(end))) {
        next->p = end;
        h = distance;
        return true;
      }
      distance += miss / coefficient(next->path.parameters, problem_.traced, 1);
      if (!(distance > 0.0 && distance <= 1.5 * h)) return false;
    }
    return false;
  }
  return true;
}

/// An eigenvalue at zero is where the equilibrium is not isolated: the path turns back, or another one
/// crosses.
void Tracer::add_static_event(const PathNode& node, Event event) {
  const bool moves = !problem_.structure.known_equilibrium;
  const double scale = std::max(problem_.s_ref, 1e-300);
  const bool zero = std::abs(event.s) <= 1e-2 * scale;
  const bool of_one = event.kind == EventKind::crossing && event.modes.size() == 1;
  if (!moves || !zero ||
      !(event.kind == EventKind::collision || event.kind == EventKind::divergence || of_one)) {
    return add_event(std::move(event));
  }
  // The branch point is an event of its own.
  if (bridge_ && std::abs(event.p - branch_.p) <= 1e-8 * range()) return;
  const double share =
      kernel_share_of_parameter(problem_.model, node.path, problem_.traced, node.linearization,
                                node.basis.T[0], result_.counts.evaluations);
  if (share > branch_point_share) return;  // the fold is an event of its own
  event.kind = EventKind::pitchfork;
  event.puiseux = 0.0;
  event.s = 0.0;
  event.modes.clear();
  note_branch_point(event.p);
  add_event(std::move(event));
}

void Tracer::note_branch_point(double p) {
  result_.notes.push_back("another equilibrium path crosses at " + at_parameter(p) +
                          "; the trace stays on its own");
}

double Tracer::fold_distance(const PathNode& node) const {
  const auto& p = node.path.parameters;
  return -coefficient(p, problem_.traced, 1) / (2.0 * coefficient(p, problem_.traced, 2));
}

/// dp/dsigma beside a point, on the side of `towards`: of a point that lies on a fold, up to rounding, its
/// own means nothing.
double Tracer::heading(const PathNode& node, double towards) const {
  const bool on_it = std::abs(fold_distance(node)) <= on_fold;
  return on_it ? 2.0 * coefficient(node.path.parameters, problem_.traced, 2) * towards
               : coefficient(node.path.parameters, problem_.traced, 1);
}

/// A fold becomes a point of the trace: beside it p(sigma) has to be told relatively to its value there, for
/// eigenvalues vary like the root of the distance.
bool Tracer::land_on_fold(double& h, std::optional<PathNode>& next) {
  if (!plane_) return true;
  const double before = heading(node_, h);
  const double behind = heading(*next, -h);
  if (!(before * behind < 0.0)) return true;
  const EventWork work(result_.counts);
  double distance = h * before / (before - behind);
  double last_move = INFINITY;
  for (int i = 0; i < most_retrackings; ++i) {
    if (attempt(distance, next)) return false;
    const double move = fold_distance(*next);
    if (std::abs(move) <= 1e-13 || (std::abs(move) > 0.5 * last_move && std::abs(move) <= on_fold)) {
      h = distance;
      return true;
    }
    last_move = std::abs(move);
    distance += move;
    if (!(distance / h > 0.0 && distance / h < 1.0)) return false;
  }
  return false;
}

/// The modes and the shape of the eigenvalue that vanishes with the tangent stiffness.
void Tracer::keep_vanishing_mode(const PathNode& node, Event& event) const {
  double least = INFINITY;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& track = node.tracks[i];
    const double size = std::abs(chart_value(track.roots.mean(), track.pair.chart));
    if (size >= least) continue;
    least = size;
    event.modes = sorted_modes(track.arriving);
    Eigen::Index member = 0;
    track.roots.cwiseAbs().minCoeff(&member);
    keep_shape(node, i, {static_cast<int>(member)}, 0.0, event);
  }
}

void Tracer::find_folds(double h, const PathNode& next) {
  if (!plane_ || !(heading(next, -h) * heading(next, h) < 0.0)) return;
  if (on_branch_point(coordinate(next.path.x.col(0), next.p))) return;
  const double share =
      kernel_share_of_parameter(problem_.model, next.path, problem_.traced, next.linearization,
                                next.basis.T[0], result_.counts.evaluations);
  Event event;
  event.kind = share > branch_point_share ? EventKind::fold : EventKind::pitchfork;
  if (event.kind == EventKind::pitchfork) note_branch_point(next.p);
  event.p = next.p + 0.5 * fold_distance(next) * coefficient(next.path.parameters, problem_.traced, 1);
  event.retrackings = 1;
  event.node = result_.nodes;
  keep_vanishing_mode(next, event);
  if (event.kind == EventKind::fold) keep_fold_sensitivities(next, event);
  add_event(std::move(event));
}

}  // namespace eigentrail
