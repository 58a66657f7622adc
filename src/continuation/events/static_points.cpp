#include "continuation/events/static_points.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/events/event_record.hpp"
#include "continuation/step/step_error.hpp"
#include "continuation/tracks/members.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/continuation/path_step.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/steady/kkt_factorization.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {
namespace {

/// As a share of the range: an event this close to the branch point on the bridge is that branch point. The
/// place of a double eigenvalue is known to about the square root of rounding.
constexpr double at_branch_point = 1e-8;
/// As a share of the range: where the eigenvalue that is zero at a branch point is looked at, far above
/// rounding.
constexpr double close_to_branch_point = 1e-6;
/// Product of the shapes of a mode and of the kernel, both of unit norm, from which on they are one motion:
/// the kernel is that of a mode to the accuracy of the projection, or it is another motion.
constexpr double same_motion = 0.9;
/// Smallest reference magnitude of eigenvalues, 1/s: keeps the limit of zero eigenvalues above zero.
constexpr double least_reference = 1e-300;

std::string note_on_branch_point(const EventSearch& search, double p) {
  return "another equilibrium path crosses at " + place_text(search.options, p) +
         "; the trace stays on its own";
}

/// Share of the force of the traced parameter in the kernel of the singular stiffness: zero at a branch
/// point, not at a fold.
double kernel_share(const EventSearch& search, const PathNode& node) {
  const PathProblem& problem = search.problem();
  return kernel_share_of_parameter(problem.model, node.path, problem.traced, node.linearization,
                                   node.basis.T[0], search.solver.counts().evaluations);
}

/// Whether the two folds beside a point, or the one on it and the next, have the same p to what is accepted
/// of it: p = c1 h + c2 h^2 + c3 h^3 is stationary at places whose p differ by 4 |c2^2 - 3 c1 c3|^(3/2) / (27
/// c3^2).
bool is_cusp(const EventSearch& search, const PathNode& node) {
  const PathFrame& frame = search.frame();
  const auto c = [&](Eigen::Index k) { return coefficient(node.path.parameters, frame.range.traced, k); };
  const double discriminant = c(2) * c(2) - 3.0 * c(1) * c(3);
  return frame.plane && 4.0 * std::pow(std::abs(discriminant), 1.5) <=
                            27.0 * c(3) * c(3) * accepted_parameter_error(frame, search.options.tolerance);
}

/// Sets modes and shape of an event from the eigenvalue that is nearest to zero.
void keep_vanishing_mode(const PathNode& node, Event& event) {
  double least = INFINITY;
  for (const Track& track : node.tracks) {
    const double size = std::abs(chart_value(track.roots.mean(), track.pair.chart));
    if (size >= least) continue;
    least = size;
    event.modes = sorted_modes(track.arriving);
    Eigen::Index member = 0;
    track.roots.cwiseAbs().minCoeff(&member);
    keep_shape(node, track, {static_cast<int>(member)}, 0.0, event);
    event.copies.clear();
  }
}

/// The same in a projected scene, where the motion may be none of the followed modes: its shape is the kernel
/// of the whole stiffness, and modes are kept only if it is theirs.
void keep_vanishing_motion(const EventSearch& search, const PathNode& node, Event& event) {
  keep_vanishing_mode(node, event);
  if (search.problem().model.projection() == nullptr) return;
  const auto kernel = kkt_kernel(node.linearization.K[0].sparse(), node.linearization.A[0].sparse());
  if (!kernel) return;
  const ComplexVector of_mode = event.shape;
  keep_shape(node, 0, kernel->right.cast<Complex>(), event);
  const ComplexVector inertia = node.linearization.M[0] * event.shape;  // both shapes have unit M-norm
  if (!(std::abs(inertia.dot(of_mode)) >= same_motion)) event.modes.clear();
}

/// 1 where an eigenvalue that is zero at a branch point is real and grows above it on the path of the trace,
/// -1 where it does below. Beside the point such a one is real, and any other one of a pair that decays or
/// oscillates there.
int direction_of_growth(const EventSearch& search, const PathNode& node) {
  const double small = close_to_branch_point * search.frame().coordinate_range();
  const auto growing = [&](double distance) {
    Eigen::Index count = 0;
    for (const Track& track : node.tracks) {
      const ComplexVector roots = block_roots(evaluate_series(track.functions, distance));
      count += (roots.array().real() > 0.5 * roots.array().abs()).count();
    }
    return count;
  };
  const auto change = static_cast<double>(growing(small) - growing(-small)) * search.frame().speed(node);
  return change > 0.0 ? 1 : change < 0.0 ? -1 : 0;
}

/// In steps: distance from an end of the step that is a fold, where the sign is taken instead.
constexpr double beside_fold = 1e-3;
/// Reciprocal condition up to which rounding decides the sign, as where nothing holds a freedom. It also is
/// the accuracy of the place.
constexpr double rounding_decides = 1e-12;
/// As many as a double has bits: rounding ends the search before.
constexpr int most_halvings = 53;

/// The path on a step, from 0 at its left end to 1.
class TrimmedStep {
 public:
  TrimmedStep(const EventSearch& search, const Step& step)
      : problem_(search.problem()),
        counts_(search.solver.counts().evaluations),
        path_(0.0, step.h, step.left->path, step.right.path, problem_.traced, true),
        length_(step.h) {}

  /// Sign of the determinant over that of dp/dsigma; 0 where rounding decides it.
  int sign(double t) const {
    const Path path = path_.path(t * length_, 1);
    const Path at{path.parameters.col(0), path.x.col(0), path.lambda.col(0)};
    Linearization linearization;
    TrimDerivatives trim;
    if (problem_.model.linearize(at, 0, linearization, counts_) ||
        problem_.model.trim_derivatives(at, trim, counts_))
      return 0;
    const KktFactorization kkt(linearization.K[0], linearization.A[0], trim);
    if (!(kkt.reciprocal_condition() > rounding_decides)) return 0;
    return path.parameters(problem_.traced, 1) > 0.0 ? kkt.orientation() : -kkt.orientation();
  }

  double p(double t) const { return path_.path(t * length_, 0).parameters(problem_.traced, 0); }

 private:
  const PathProblem& problem_;
  EvaluationCounts& counts_;
  Bridge path_;
  double length_;
};

/// Where the sign changes between a and b, by bisection.
double place_of_change(const TrimmedStep& path, double a, double b, int sign_at_a) {
  for (int i = 0; i < most_halvings; ++i) {
    const double middle = 0.5 * (a + b);
    const int sign = path.sign(middle);
    if (sign == 0) return middle;
    (sign == sign_at_a ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

}  // namespace

FoundEvents find_fold(const EventSearch& search, const PathNode& node, double h) {
  const PathFrame& frame = search.frame();
  if (!frame.plane || !(heading(frame, node, -h) * heading(frame, node, h) < 0.0)) return {};
  if (frame.on_branch_point(node)) return {};
  // With trimmed parameters the path turns back where the steady equations with the conditions are singular;
  // the stiffness, of motion with these parameters held, is not.
  const bool trimmed = search.problem().model.n_trims() > 0;
  const bool is_fold = trimmed || kernel_share(search, node) > search.thresholds().statics.branch_point_share;
  const EventKind of_limit = is_fold && is_cusp(search, node) ? EventKind::cusp : EventKind::fold;
  // The vertex of the parabola p(h): with the distance d to it and the slope at the point, p changes by
  // d / 2 times the slope on the way.
  Event event{.kind = is_fold ? of_limit : EventKind::branch_point,
              .p = node.p + 0.5 * fold_distance(frame, node) * frame.speed(node),
              .retrackings = 1,
              .node = search.node};
  if (!trimmed) keep_vanishing_motion(search, node, event);
  if (trimmed || event.kind == EventKind::cusp)  // no other parameter only moves a cusp: it becomes two folds
    leave_unknown(search.problem(), event);
  else if (is_fold)
    keep_fold_sensitivities(search.problem(), node, event, search.solver.counts());
  FoundEvents found{{std::move(event)}};
  if (!is_fold) found.notes.push_back(note_on_branch_point(search, node.p));
  return found;
}

FoundEvents find_branch_point(const EventSearch& search, const PathNode& node) {
  if (!search.frame().on_branch_point(node)) return {};
  Event event{.kind = EventKind::branch_point,
              .p = search.frame().branch_point.p,
              .direction = direction_of_growth(search, node),
              .retrackings = 1,
              .node = search.node};
  keep_vanishing_motion(search, node, event);
  event.modes.clear();  // the mode numbers are those of one path; the point belongs to both
  return {{std::move(event)}};
}

FoundEvents as_static_event(const EventSearch& search, const PathNode& node, Event event) {
  const PathProblem& problem = search.problem();
  const PathFrame& frame = search.frame();
  const StaticThresholds& thresholds = search.thresholds().statics;
  const bool is_zero = std::abs(event.s) <= thresholds.zero * std::max(problem.s_ref, least_reference);
  const bool of_one = event.kind == EventKind::crossing && event.modes.size() == 1;
  const bool may_be = event.kind == EventKind::collision || event.kind == EventKind::divergence || of_one;
  const bool passes = problem.structure.known_equilibrium || problem.model.n_trims() > 0;
  if (passes || !is_zero || !may_be) return {{std::move(event)}};
  if (frame.bridge && std::abs(event.p - frame.branch_point.p) <= at_branch_point * frame.range.length())
    return {};
  const bool is_limit = kernel_share(search, node) > thresholds.branch_point_share;
  if (is_limit && !is_cusp(search, node)) return {};
  event.puiseux = 0.0;
  event.s = 0.0;
  if (is_limit) {
    event.kind = EventKind::cusp;
    event.direction = 0;
    leave_unknown(problem, event);
    return {{std::move(event)}};
  }
  event.kind = EventKind::branch_point;
  event.modes.clear();
  event.copies.clear();
  std::string note = note_on_branch_point(search, event.p);
  return {{std::move(event)}, {std::move(note)}};
}

FoundEvents find_trimmed_crossing(const EventSearch& search, const Step& step) {
  const PathFrame& frame = search.frame();
  if (search.problem().model.n_trims() == 0) return {};
  const auto is_fold = [&](const PathNode& node) {
    return frame.plane && std::abs(fold_distance(frame, node)) <= on_fold;
  };
  const TrimmedStep path(search, step);
  const double begin = is_fold(*step.left) ? beside_fold : 0.0;
  const double end = is_fold(step.right) ? 1.0 - beside_fold : 1.0;
  const int before = path.sign(begin), behind = path.sign(end);
  if (before * behind >= 0) return {};
  Event event{.kind = EventKind::branch_point,
              .p = path.p(place_of_change(path, begin, end, before)),
              .node = search.node};
  leave_unknown(search.problem(), event);
  std::string note = "another trimmed path crosses at " + place_text(search.options, event.p) +
                     "; the trace stays on its own, and branches there cannot be chosen";
  return {{std::move(event)}, {std::move(note)}};
}

}  // namespace eigentrail
