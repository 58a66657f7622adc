#include "continuation/step/step_error.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "continuation/step/shared_basis.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

/// Accepted error of p on a step, in units of tolerance times range, if the coordinate is the distance across
/// a plane. Near a fold eigenvalues vary like the square root of the distance in p, so p must be more
/// accurate than they are. A larger value loses accuracy near folds, a smaller one needs more steps there.
constexpr double parameter_accuracy = 1e-5;

/// Truncation errors of a part of an accurate step, as a share of those of the whole step. If this share is
/// smaller, the part is accurate even if the error of the whole step was estimated a million times too small.
/// A larger estimate for the part then shows rounding in two points that are close to each other, or
/// eigenvalues that coincide at its end; a shorter step would not lower it.
constexpr double negligible_share = 1e-6;

bool is_short_part(const PathProblem& problem, const Step& step) {
  if (step.whole == 0.0) return false;
  return std::pow(std::abs(step.h / step.whole), 2.0 * problem.order + 2.0) <= negligible_share;
}

/// In t: distance from an end of the step with coinciding eigenvalues at which the error is evaluated
/// instead.
constexpr double beside_meeting = 0.1;

/// Rounding of the equilibrium that p is solved for with, and of the sums of its interpolant, in units of the
/// last place.
constexpr double rounding_of_sums = 8.0;

/// Estimated error of p on a step / accepted error, which is at least that by rounding.
double parameter_error(const PathFrame& frame, double tolerance, const Step& step) {
  const int traced = frame.range.traced;
  const auto row = [&](const PathNode& node) {
    return ComplexMatrix(node.path.parameters.row(traced).cast<Complex>());
  };
  double rounding = 0.0;
  for (const PathNode* node : {step.left, &step.right})
    rounding =
        std::max({rounding, rounding_of_sums * std::numeric_limits<double>::epsilon() * std::abs(node->p),
                  rounding_along_path(*node) * std::abs(frame.speed(*node))});
  return HermiteInterpolant(step.h, row(*step.left), row(step.right)).error_without_last()[0] /
         std::max(accepted_parameter_error(frame, tolerance), rounding);
}

/// Intervals between the first samples. The functions are polynomials of degree 11 at most and usually much
/// smoother. More samples find narrower minima and cost time at every step.
constexpr std::size_t intervals = 8;
/// Accuracy of the place, as a share of the step. Beside a simple zero an eigenvalue is then at most 1e-5 of
/// its change over the step, small enough to show a large relative error.
constexpr double accuracy = 1e-5;

/// Magnitude of the product of the eigenvalues of a block at t: it vanishes where one of them does.
class Magnitude {
 public:
  explicit Magnitude(const ComplexMatrix& functions) : functions_(functions), value_(functions.rows()) {}

  double operator()(double t) {
    value_ = functions_.col(functions_.cols() - 1);
    for (Eigen::Index k = functions_.cols() - 2; k >= 0; --k) value_ = value_ * t + functions_.col(k);
    const Eigen::Index k = block_size(value_.size());
    if (k == 1) return std::abs(value_[0]);
    if (k == 2) return std::abs(value_[0] * value_[0] - value_[1]);
    return std::abs(value_.reshaped(k, k).determinant());
  }

 private:
  const ComplexMatrix& functions_;
  ComplexVector value_;
};

struct Place {
  double t = 0.0, magnitude = std::numeric_limits<double>::infinity();
};

/// Local search for a minimum from a place: tries both sides, and halves the distance.
Place refine(Magnitude& magnitude, Place best) {
  for (double reach = 0.5 / intervals; reach > accuracy; reach *= 0.5) {
    for (const double t : {std::max(best.t - reach, 0.0), std::min(best.t + reach, 1.0)}) {
      if (const double there = magnitude(t); there < best.magnitude) best = {t, there};
    }
  }
  return best;
}

/// Largest of `root error(t) / accepted error(t)` at places of a step where errors are largest, for errors of
/// the functions of a block and an error of its eigenvalues that is forgiven, 1/s.
double worst_ratio(const PathProblem& problem, double tolerance, const Step& step, std::size_t i,
                   const HermiteInterpolant& dense, const Vector& errors, double forgiven) {
  const Track& track = step.left->tracks[i];
  const auto degree = static_cast<int>(2 * track.functions.cols() - 1);
  const double smallest = place_of_least_magnitude(dense.series(0.0, degree));
  // Where roots of a block coincide, the error of a single root has no bound, although the functions of the
  // block are accurate.
  const double begin = track.departure ? beside_meeting : 0.0;
  const double end = step.meets(i) ? 1.0 - beside_meeting : 1.0;
  double worst = 0.0;
  for (const double t : {begin, 0.5, end, smallest}) {
    const ComplexVector functions = dense(t);
    // The error of the block is taken relative to its smallest eigenvalue.
    const double size = block_roots(functions).cwiseAbs().minCoeff();
    const double scale = std::max(size, problem.reference(track.pair.chart));
    const double error = (root_error(functions, errors, least_relative_gap * scale) - forgiven) /
                         (accepted_share * tolerance * scale);
    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
  }
  return worst;
}

/// Whether all eigenvalues of a track are zero within rounding, at both ends of a step and between them: then
/// no error of theirs is known.
bool is_zero(const PathProblem& problem, const Step& step, std::size_t i, const HermiteInterpolant& dense) {
  double rounding = problem.s_ref, largest = 0.0;
  for (const Track* track : {&step.left->tracks[i], &step.right.tracks[i]}) {
    largest = std::max(largest, track->roots.cwiseAbs().maxCoeff());
    if (track->pair.chart != Chart::finite || largest > problem.s_ref) return false;
    const double entries = problem.thresholds.rounding.entries;
    rounding = std::min(rounding, eigenvalue_rounding(track->pair, track->roots, entries).minCoeff());
  }
  return largest <= rounding && block_roots(dense(0.5)).cwiseAbs().maxCoeff() <= rounding;
}

Vector estimated_errors(const HermiteInterpolant& dense, const Track& track) {
  return (dense.error_without_last() - function_rounding(track.pair.Lambda)).cwiseMax(0.0);
}

}  // namespace

double place_of_least_magnitude(const ComplexMatrix& functions) {
  Magnitude magnitude(functions);
  std::array<Place, intervals + 1> samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) / intervals;
    samples[i] = {t, magnitude(t)};
  }
  Place least;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const bool falls_to_left = i > 0 && samples[i - 1].magnitude < samples[i].magnitude;
    const bool falls_to_right = i + 1 < samples.size() && samples[i + 1].magnitude < samples[i].magnitude;
    if (falls_to_left || falls_to_right) continue;
    const Place place = refine(magnitude, samples[i]);
    if (place.magnitude < least.magnitude) least = place;
  }
  return least.t;
}

double accepted_parameter_error(const PathFrame& frame, double tolerance) {
  return parameter_accuracy * tolerance * frame.range.length();
}

double rounding_along_path(const PathNode& node) {
  const SystemMatrix &K = node.linearization.K[0], &A = node.linearization.A[0];
  if (node.path.x.rows() != K.rows() || node.path.lambda.rows() != A.rows()) return 0.0;
  const Vector along = node.path.x.col(1), reaction = A.transposed_times(node.path.lambda.col(1));
  const Vector stiff = K * along;
  const auto work = [&along](const Vector& force) { return std::abs(along.dot(force)); };
  const double of_parameter = work(stiff + reaction);
  constexpr double digits = std::numeric_limits<double>::epsilon();
  if (of_parameter <= std::sqrt(digits) * (work(stiff) + work(reaction))) return 0.0;
  const Vector forces =
      K.visit([&](const auto& values) { return Vector(values.cwiseAbs() * node.path.x.col(0).cwiseAbs()); });
  return rounding_of_sums * digits * along.cwiseAbs().dot(forces) / of_parameter;
}

double sensitivity_to_rounding(const Track& track) {
  return track.pair.condition * track.pair.Lambda.norm();
}

double track_error(const PathProblem& problem, double tolerance, double rounding, const Step& step,
                   std::size_t i) {
  const Track& track = step.left->tracks[i];
  const HermiteInterpolant dense = functions_on_step(*step.left, step.right, i, step.h);
  if (is_zero(problem, step, i, dense)) return 0.0;
  return worst_ratio(problem, tolerance, step, i, dense, estimated_errors(dense, track),
                     rounding * sensitivity_to_rounding(track));
}

double known_rounding(const PathFrame& frame, const Track& track) {
  double rounding = 0.0;
  for (const int mode : track.modes) {
    if (mode >= 0 && mode < static_cast<int>(frame.rounding.size()))
      rounding = std::max(rounding, frame.rounding[static_cast<std::size_t>(mode)]);
  }
  return rounding;
}

void note_rounding(const Track& track, double seen, PathFrame& frame) {
  for (const int mode : track.modes) {
    if (mode < 0) continue;
    const auto index = static_cast<std::size_t>(mode);
    if (index >= frame.rounding.size()) frame.rounding.resize(index + 1, 0.0);
    frame.rounding[index] = std::max(frame.rounding[index], seen);
  }
}

bool series_are_exact(const PathProblem& problem, double tolerance, const Step& step, std::size_t i) {
  constexpr double negligible = 0.1;  // of the accepted error
  const HermiteInterpolant dense = functions_on_step(*step.left, step.right, i, step.h);
  const auto last = static_cast<int>(step.left->tracks[i].functions.cols()) - 1;
  for (const double end : {0.0, 1.0}) {
    const Vector terms = dense.series(end, last).rightCols(2).cwiseAbs().rowwise().sum();
    if (!(worst_ratio(problem, tolerance, step, i, dense, terms, 0.0) <= negligible)) return false;
  }
  return true;
}

double observed_rounding(const PathProblem& problem, double tolerance, const Step& step, std::size_t i) {
  // What is seen on one step may be twice as large on the next.
  constexpr double margin = 2.0;
  // Relative, for a condition of one: some hundred and eighty machine epsilons. More is no rounding.
  constexpr double largest = 4e-14;
  // The eigenvalues of larger blocks are known to a root of rounding where they meet, whatever their
  // condition.
  constexpr Eigen::Index most_members = 2;
  const Track& track = step.left->tracks[i];
  if (track.size() > most_members || !series_are_exact(problem, tolerance, step, i)) return 0.0;
  const HermiteInterpolant dense = functions_on_step(*step.left, step.right, i, step.h);
  // The ratio is to what is accepted of one eigenvalue of the track; the largest bounds it.
  const double ratio = worst_ratio(problem, tolerance, step, i, dense, estimated_errors(dense, track), 0.0);
  const double scale = std::max(track.roots.cwiseAbs().maxCoeff(), problem.reference(track.pair.chart));
  const double seen = margin * ratio * accepted_share * tolerance * scale / sensitivity_to_rounding(track);
  return seen <= largest ? seen : 0.0;
}

Verdict judge_error(const PathProblem& problem, const PathFrame& frame, double tolerance, const Step& step) {
  Verdict worst{Verdict::Kind::inaccurate, -1, 0.0,
                "the error of the dense output stays above the tolerance"};
  if (is_short_part(problem, step)) return {};
  for (std::size_t i = 0; i < step.left->tracks.size(); ++i) {
    const double error =
        track_error(problem, tolerance, known_rounding(frame, step.left->tracks[i]), step, i);
    if (error <= worst.error) continue;
    worst.error = error;
    worst.track = static_cast<int>(i);
  }
  if (frame.plane) {
    const double error = parameter_error(frame, tolerance, step);
    if (error > worst.error)
      worst = {Verdict::Kind::inaccurate, -1, error, "the parameter along the path is inaccurate"};
  }
  if (worst.error > 1.0 || std::isnan(worst.error)) return worst;
  const bool is_rounding =
      worst.track >= 0 && series_are_exact(problem, tolerance, step, static_cast<std::size_t>(worst.track));
  return {Verdict::Kind::accepted, worst.track, is_rounding ? 0.0 : worst.error};
}

}  // namespace eigentrail
