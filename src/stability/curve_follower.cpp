#include "stability/curve_follower.hpp"

#include <algorithm>
#include <cmath>

#include "core/bisection.hpp"
#include "eigentrail/continuation/step_control.hpp"

namespace eigentrail {
namespace {

// Lengths are in the scaled window.
constexpr double accepted_share = 0.5;  ///< largest accepted error estimate as a fraction of the tolerance
constexpr double first_step = 0.02;
constexpr double longest_step = 0.1;
constexpr double shortest_step = 1e-9;
constexpr double same_place = 1e-9;  ///< places closer than this are one
/// Error, relative to the allowed one, that the step control gets if a tangent at an end of the step deviates
/// too much from the chord.
constexpr double bent_too_much = 30.0;
constexpr int curve_samples_per_step = 16;
/// If the step becomes too short and another eigenvalue is closer than this multiple of |s|, the curve ends
/// at an exceptional point.
constexpr double coalescing = 1e-3;
/// Steps shrink with the distance from a fold of the equilibrium. Shorter steps than this near a fold are
/// useless, because rounding errors grow there; the curve ends.
constexpr double shortest_beside_fold = 1e-6;

/// Whether the dense output of a step passes through a place with the eigenvalue `s` there. The tolerances
/// exceed the sum of the errors of the two curves compared.
bool step_passes(const ChordStep& step, const Place& place, Complex s, double tolerance, double s_ref) {
  const double reach = 3.0 * tolerance + same_place;
  const Place middle = 0.5 * (step.left.col(0) + step.right.col(0)).head<2>();
  if ((place - middle).norm() > 2.0 * step.length + reach) return false;
  double t = 0.0;
  if (distance_from(step, place, t) > reach) return false;
  const Eigen::Vector4d there = step(t);
  const Complex root = there[2] + std::sqrt(Complex(there[3]));
  const double near = std::max(10.0 * tolerance, 1e-5) * std::max(std::abs(s), s_ref);
  return std::min(std::abs(root - s), std::abs(root - std::conj(s))) <= near;
}

/// The first t in [0, 1] at which `value` becomes negative, by bisection between samples; above 1 if there is
/// none.
template <class Value>
double first_negative(Value&& value) {
  for (int k = 1; k <= curve_samples_per_step; ++k) {
    const double before = (k - 1.0) / curve_samples_per_step;
    const double behind = static_cast<double>(k) / curve_samples_per_step;
    if (value(behind) >= 0.0) continue;
    constexpr int halvings = 45;
    return bisected(before, behind, halvings, [&](double t) { return !(value(t) < 0.0); }).last;
  }
  return 2.0;
}

/// The part of a curve on one side of its seed.
class Arm {
 public:
  Arm(const Window& window, const BoundaryFunction& function, const TraceOptions& options,
      const CurvePoint& seed, double sign, const OnPoint& on_point, RunCounts& counts)
      : points{seed},
        window_(window),
        function_(function),
        options_(options),
        sign_(sign),
        on_point_(on_point),
        counts_(counts) {}

  void follow() {
    StepControl control(window_.order(), first_step, longest_step, shortest_step);
    while (advance(control)) {
    }
  }

  std::vector<CurvePoint> points;  ///< from the seed on
  /// Each step points in the direction of the curve. If `sign_` is negative, that is from the end of the arm
  /// towards the seed.
  std::vector<ChordStep> steps;
  ArmEnd end;
  int rejected = 0;

 private:
  enum class Landing { nothing, landed, failed };

  /// Tries one step. Returns whether the arm goes on.
  bool advance(StepControl& control) {
    const double h = control.propose(10.0);  // more than the diagonal of the window: no remaining range
    const Place across(-last().tangent().y(), last().tangent().x());
    const Situation there = correct_along(window_, function_, predict(last(), sign_ * h), across, counts_);
    if (!there.computed()) return reject(control, h, INFINITY, there.point.message, there.point.status);
    std::optional<CurvePoint> next = expand_curve(window_, function_, there, last().tangent(), counts_);
    if (!next) return reject(control, h, INFINITY, "a series is not finite");
    const std::optional<ChordStep> step = step_to(*next);
    if (!step) return reject(control, h, bent_too_much, "the curve turns too sharply");
    const double error = error_of(*step);
    if (!(error <= 1.0)) return reject(control, h, error, "the series at both ends do not agree");
    switch (land(*step)) {
      case Landing::landed:
        return false;
      case Landing::failed:
        return reject(control, h, INFINITY, "its end could not be located");
      default:
        break;
    }
    control.accept(h, error);
    points.push_back(std::move(*next));
    steps.push_back(*step);
    if (last().is_beside_fold && h < shortest_beside_fold) return stop_at_fold();
    on_point_();
    if (static_cast<int>(points.size()) < options_.max_nodes) return true;
    return stop(CurveEnd::lost,
                "stopped after " + std::to_string(points.size()) + " points; raise max_nodes");
  }

  /// If the arm ends within the step (edge of the window, end of the curve, return to the seed), computes the
  /// first such end.
  Landing land(const ChordStep& step) {
    const double edge = first_negative([&](double t) {
      const Place place = at(step, t).head<2>();
      constexpr double rounding = 1e-13;
      return std::min(place.minCoeff(), 1.0 - place.maxCoeff()) + rounding;
    });
    const double last = first_negative([&](double t) {
      const Eigen::Vector4d there = at(step, t);
      return function_.distance_to_end(there[2], there[3]);
    });
    double seed = 2.0;
    const CurvePoint& first = points.front();
    if (points.size() > 1 &&
        step_passes(step, first.place(), first.s, options_.tolerance, window_.reference())) {
      distance_from(step, first.place(), seed);
      if (sign_ < 0.0) seed = 1.0 - seed;
    }
    if (seed <= std::min(edge, last)) return seed > 1.0 ? Landing::nothing : close();
    return edge <= last ? land_on_edge(step, edge) : land_on_end(step, last);
  }

  /// Ends on the edge of the window that the step crosses at t.
  Landing land_on_edge(const ChordStep& step, double t) {
    PlaceGuess guess = guess_at(step, t);
    // `axis` is the coordinate that is at its bound; it is held there.
    const Place bound = guess.place.array().round().cwiseMax(0.0).cwiseMin(1.0);
    Eigen::Index axis = 0;
    (guess.place - bound).cwiseAbs().minCoeff(&axis);
    guess.place[axis] = bound[axis];
    const Situation there = correct_along(window_, function_, guess, Place::Unit(1 - axis), counts_);
    const Landing landing = finish(there, edge_flag, CurveEnd::edge);
    return landing == Landing::failed ? cut_on_edge(step, t, guess) : landing;
  }

  /// Ends on the edge with the dense output of the step instead of Newton's method. Needed where g vanishes
  /// all along the edge, as for a system without damping: g = 0 then does not determine the place.
  Landing cut_on_edge(const ChordStep& step, double t, const PlaceGuess& guess) {
    const Situation there = compute_situation(window_, function_, guess, counts_);
    if (!there.computed()) return Landing::failed;
    const Matrix series = step.series(sign_ > 0.0 ? t : 1.0 - t);
    if (!append(point_on_dense_curve(window_, function_, there, series, last(), counts_)))
      return Landing::failed;
    points.back().flags = edge_flag;
    stop(CurveEnd::edge);
    return Landing::landed;
  }

  /// Ends at the Takens-Bogdanov point near t, where tau = delta = 0.
  Landing land_on_end(const ChordStep& step, double t) {
    return finish(correct_to_end(window_, function_, guess_at(step, t), counts_), takens_bogdanov_flag,
                  CurveEnd::takens_bogdanov);
  }

  /// Ends by joining the seed.
  Landing close() {
    // If the last point is very close to the seed compared with the last step, it is removed: the step from
    // it to the seed would be too short.
    if ((points.front().place() - last().place()).norm() < 1e-3 * steps.back().length && points.size() > 2) {
      points.pop_back();
      steps.pop_back();
    }
    if (!append(points.front())) return Landing::failed;
    stop(CurveEnd::closed);
    return Landing::landed;
  }

  /// Appends the last point, unless the arm is there already, and sets its flag and the kind of end.
  Landing finish(const Situation& there, PointFlag flag, CurveEnd how) {
    if (!there.computed() || (how == CurveEnd::edge && !Window::contains(there.place)))
      return Landing::failed;
    if ((there.place - last().place()).norm() > same_place) {
      std::optional<CurvePoint> next = expand_curve(window_, function_, there, last().tangent(), counts_);
      if (!next) return Landing::failed;
      if (flag == takens_bogdanov_flag) {
        // The double eigenvalue is zero. QZ gives it to half the digits only, so |s| and the comparison with
        // the other modes would be wrong.
        next->s = 0.0;
        next->others = last().others;
      }
      if (!append(std::move(*next))) return Landing::failed;
    }
    points.back().flags |= flag;
    stop(how);
    return Landing::landed;
  }

  /// Appends a point and the step to it; false if the step is not accurate enough.
  bool append(CurvePoint next) {
    const std::optional<ChordStep> step = step_to(next);
    if (!step || !(error_of(*step) <= 1.0)) return false;
    points.push_back(std::move(next));
    steps.push_back(*step);
    return true;
  }

  /// Shortens the step. Returns false, with the reason of the end set, if it is too short already.
  bool reject(StepControl& control, double h, double error, const std::string& why,
              PointStatus status = PointStatus::mode_lost) {
    ++rejected;
    control.reject(h, error);
    if (!control.exhausted()) return true;
    const std::string where = window_.text(last().place());
    if (last().is_beside_fold) return stop_at_fold();
    if (status == PointStatus::no_equilibrium)
      return stop(CurveEnd::equilibrium_ends, "no equilibrium beyond " + where);
    if (last().gap < coalescing * std::max(std::abs(last().s), window_.reference()))
      return stop(CurveEnd::exceptional_point, "its mode coalesces with another one near " + where);
    return stop(CurveEnd::lost, "the step became too small at " + where + ": " + why);
  }

  bool stop(CurveEnd how, std::string why = {}) {
    end = {how, std::move(why)};
    return false;
  }
  const CurvePoint& last() const { return points.back(); }
  bool stop_at_fold() {
    return stop(CurveEnd::equilibrium_ends, "the equilibrium folds near " + window_.text(last().place()));
  }
  std::optional<ChordStep> step_to(const CurvePoint& next) const {
    return sign_ > 0.0 ? make_chord_step(last(), next) : make_chord_step(next, last());
  }
  double error_of(const ChordStep& step) const {
    return step.error(accepted_share * options_.tolerance, window_.reference());
  }
  /// The dense output of a step with t counted from the last point.
  Eigen::Vector4d at(const ChordStep& step, double t) const { return step(sign_ > 0.0 ? t : 1.0 - t); }
  /// The prediction from the last point at the place of t.
  PlaceGuess guess_at(const ChordStep& step, double t) const {
    const Place place = at(step, t).head<2>();
    return predict(last(), last().tangent().dot(place - last().place()));
  }

  const Window& window_;
  const BoundaryFunction& function_;
  const TraceOptions& options_;
  double sign_;
  const OnPoint& on_point_;
  RunCounts& counts_;
};

/// A seed is accurate to the trace's tolerance. One that Newton's method moves farther than this, in the
/// scaled window, is rejected: Newton found another boundary.
constexpr double longest_correction = 0.03;
/// If |grad g| over the scaled window is less than this multiple of |s| (divergence: of the norm of K), g
/// counts as constant: its zero set is no curve.
constexpr double flat = 1e-8;
/// Relative distance of two eigenvalues that are one, with a margin on the root of rounding.
constexpr double double_root = 1e-6;

/// The point of the boundary near a seed, by Newton's method. The first attempt moves along the line on which
/// the seed was found, so a seed on an edge stays there. Further attempts move along grad g, P and Q.
Situation correct_seed(const Window& window, const BoundarySeed& seed, const BoundaryFunction& function,
                       RunCounts& counts) {
  const PathProblem problem = window.at(seed.place);
  const PathPoint point =
      reduce_at(problem, problem.parameters[problem.traced], seed.equilibrium, Matrix(), counts);
  if (point.status != PointStatus::computed) return failed_situation(point.status, point.message);
  Situation failed = failed_situation(PointStatus::mode_lost, "");
  Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  ++counts.spectra;
  if (spectrum.modes.empty()) return failed;
  std::sort(spectrum.modes.begin(), spectrum.modes.end(),
            [&](const auto& a, const auto& b) { return std::abs(a.s - seed.s) < std::abs(b.s - seed.s); });
  if (seed.kind != BoundaryKind::divergence && spectrum.modes[0].s.imag() == 0.0) return failed;
  if (seed.kind == BoundaryKind::coalescence && spectrum.modes.size() < 2) return failed;
  const PlaceGuess guess{seed.place,
                         {point.equilibrium.x, point.equilibrium.lambda, true},
                         starting_block(seed.kind, point, spectrum.modes),
                         point.basis.T[0]};
  const Place gradient_itself = Place::Zero();  // correct_along takes zero as the direction of grad g
  for (const Place& direction :
       {seed.direction, gradient_itself, Place(Place::UnitX()), Place(Place::UnitY())}) {
    const Situation there = correct_along(window, function, guess, direction, counts);
    const bool near = there.computed() && Window::contains(there.place) &&
                      (there.place - seed.place).norm() < longest_correction;
    if (near) return there;
    failed.point.message =
        there.computed() ? "Newton's method left for " + window.text(there.place) : there.point.message;
  }
  return failed;
}

}  // namespace

CurveStart start_curve(const Window& window, const BoundaryOptions& options, const BoundarySeed& seed) {
  CurveStart start;
  const BoundaryFunction function = function_of(seed.kind, options);
  const Situation there = correct_seed(window, seed, function, start.counts);
  if (!there.computed()) {
    start.failed = true;
    start.findings.push_back(
        {"changes of stability that could not be followed",
         boundary_name(seed.kind) + " near " + window.text(seed.place) + ": " + there.point.message});
    return start;
  }
  const double tau = there.functions(0, 0).real();
  const double delta = there.functions.rows() > 1 ? there.functions(1, 0).real() : 0.0;
  // tau = 0 with two real eigenvalues of opposite sign (flutter), or tau of the wrong sign (damping ratio).
  if (function.distance_to_end(tau, delta) <= 0.0) return start;
  const auto gradients = function_gradients(window, there, function, start.counts);
  const double size = seed.kind == BoundaryKind::divergence
                          ? there.pencil.K[0].norm()
                          : std::max(there.pair.Lambda.norm(), window.reference());
  if (!gradients || !(gradients->row(function.row()).norm() > flat * size)) return start;
  start.point = expand_curve(window, function, there, Place::Zero(), start.counts);
  if (!start.point) return start;
  // Where two undamped modes meet, Re s is zero on one side at all places: they have a seed of their own.
  const double scale = std::max(std::abs(start.point->s), window.reference());
  if (seed.kind == BoundaryKind::flutter && start.point->gap <= double_root * scale) start.point.reset();
  if (seed.kind != BoundaryKind::coalescence) return start;
  // Damped modes do not meet; the curve would go on where their mean is no mode.
  if (start.point->functions.row(0).cwiseAbs().maxCoeff() <= flat * size) return start;
  start.point.reset();
  start.findings.push_back(
      {"onset of flutter without damping, beside which modes are damped; as damping vanishes, the "
       "boundary may have another limit",
       window.text(there.place)});
  return start;
}

bool FollowedCurve::passes(const Place& place, Complex s, double tolerance, double s_ref) const {
  return std::any_of(steps.begin(), steps.end(),
                     [&](const ChordStep& step) { return step_passes(step, place, s, tolerance, s_ref); });
}

FollowedCurve follow_curve(const Window& window, const BoundaryFunction& function,
                           const TraceOptions& options, CurvePoint seed, const OnPoint& on_point) {
  seed.flags |= seed_flag;
  FollowedCurve curve;
  curve.function = function;
  Arm ahead(window, function, options, seed, 1.0, on_point, curve.counts);
  ahead.follow();
  curve.rejected_steps = ahead.rejected;
  curve.end = curve.begin = ahead.end;
  curve.points = std::move(ahead.points);
  curve.steps = std::move(ahead.steps);
  if (curve.end.how == CurveEnd::closed) return curve;
  Arm back(window, function, options, seed, -1.0, on_point, curve.counts);
  back.follow();
  curve.rejected_steps += back.rejected;
  curve.begin = back.end;
  std::reverse(back.points.begin(), back.points.end());
  std::reverse(back.steps.begin(), back.steps.end());
  curve.points.front().flags |= back.points.back().flags;  // both points are the seed
  back.points.pop_back();
  curve.points.insert(curve.points.begin(), back.points.begin(), back.points.end());
  curve.steps.insert(curve.steps.begin(), back.steps.begin(), back.steps.end());
  return curve;
}

}  // namespace eigentrail
