#include "stability/curve_start.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace eigentrail {
namespace {

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
  Situation failed;
  failed.status = point.status;
  failed.message = point.message;
  if (point.status != PointStatus::computed) return failed;
  Spectrum spectrum = compute_spectrum(point.pencil.M[0], point.pencil.C[0], point.pencil.K[0]);
  ++counts.spectra;
  failed.status = PointStatus::mode_lost;
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
    const bool near = there.status == PointStatus::computed && Window::contains(there.place) &&
                      (there.place - seed.place).norm() < longest_correction;
    if (near) return there;
    failed.message = there.status == PointStatus::computed
                         ? "Newton's method left for " + window.text(there.place)
                         : there.message;
  }
  return failed;
}

}  // namespace

BoundaryFunction function_of(const BoundarySeed& seed, const BoundaryOptions& options) {
  return {seed.kind, options.damping_ratio.value_or(0.0)};
}

CurveStart start_curve(const Window& window, const BoundaryOptions& options, const BoundarySeed& seed) {
  CurveStart start;
  const BoundaryFunction function = function_of(seed, options);
  const Situation there = correct_seed(window, seed, function, start.counts);
  if (there.status != PointStatus::computed) {
    start.failure = boundary_name(seed.kind) + " near " + window.text(seed.place) + ": " + there.message;
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
  start.remark =
      "onset of flutter without damping, beside which modes are damped; as damping vanishes, the "
      "boundary may have another limit";
  return start;
}

}  // namespace eigentrail
