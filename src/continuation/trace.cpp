#include "eigentrail/continuation/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/step_control.hpp"
#include "eigentrail/modes/matching.hpp"
#include "eigentrail/modes/spectrum.hpp"

namespace eigentrail {
namespace {

/// A diagonal modal assurance below this makes a match suspicious.
constexpr double least_assurance = 0.8;
/// Two tracks closer than this, relatively, with parallel vectors have merged.
constexpr double merged_distance = 1e-8;
constexpr double merged_assurance = 0.999;

/// A step is accepted up to this share of the tolerance. The estimate from the decay of the terms is right
/// within a factor of about two; with few terms to see (orders 1 and 2) less so.
double accepted_share(int order) {
  return order <= 2 ? 0.25 : 0.5;
}

constexpr double smallest_step = 1e-11;  ///< of the range

constexpr double reference_share = 1e-3;  ///< s_ref / median |s| at the start

std::string at_parameter(const TraceOptions& options, double p) {
  std::ostringstream text;
  text.precision(12);
  text << options.parameter << " = " << p;
  return text.str();
}

/// Continuation of one trace. The public function below builds it and returns its result.
class Tracer {
 public:
  Tracer(const Model& model, const TraceOptions& options, const TraceObserver& observer, BasisChoice basis)
      : options_(options), observer_(observer), problem_(problem_along(model, options.parameter)) {
    problem_.order = options.order;
    problem_.basis = basis;
    result_.counts.evaluations = model.new_counts();
    direction_ = options.to > options.from ? 1.0 : -1.0;
  }

  TraceResult run() {
    const auto begin = std::chrono::steady_clock::now();
    if (start()) follow();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  /// First point: equilibrium from the scene's guess, spectrum, choice of modes.
  bool start() {
    RunCounts& counts = result_.counts;
    const Vector guess = problem_.model.initial_guess(parameters_at(problem_, options_.from));
    PathPoint point = reduce_at(problem_, options_.from, {guess, Vector()}, Matrix(), counts);
    if (point.status != PointStatus::computed) return stop(TraceStatus::no_equilibrium, point.message);
    result_.n_independent = point.pencil.size();
    const auto modes = starting_modes(point.pencil);
    if (!modes) return false;
    if (!correct_start(point, *modes)) return false;
    auto node = differentiate_point(problem_, point, counts);
    if (!node) return stop(TraceStatus::multiple_mode, "a series at the start is not finite");
    observer_.started({problem_.s_ref, result_.n_available});
    return keep(std::move(*node));
  }

  /// The modes to follow, and the magnitude that counts as zero.
  std::optional<std::vector<StartingMode>> starting_modes(const ReducedPencil& pencil) {
    const StageTimer timer(result_.counts.modes_seconds);
    Spectrum spectrum = compute_spectrum(pencil.M[0], pencil.C[0], pencil.K[0]);
    result_.n_infinite = spectrum.n_infinite;
    result_.n_available = static_cast<int>(spectrum.modes.size());
    const std::string where = " at " + at_parameter(options_, options_.from);
    if (spectrum.status == SpectrumStatus::singular_pencil) {
      stop(TraceStatus::singular_pencil,
           "the pencil is singular" + where +
               ": every number is an eigenvalue. A freedom "
               "without mass, damping and stiffness causes this; remove or constrain it");
      return std::nullopt;
    }
    if (spectrum.status != SpectrumStatus::complete) {
      stop(TraceStatus::no_modes, "LAPACK's QZ did not converge" + where);
      return std::nullopt;
    }
    if (spectrum.modes.empty()) {
      stop(TraceStatus::no_modes,
           "there are no modes to follow" + where +
               (result_.n_independent == 0 ? ": the constraints leave no freedom" : ""));
      return std::nullopt;
    }
    auto& modes = spectrum.modes;
    if (options_.modes && *options_.modes < static_cast<int>(modes.size())) {
      modes.resize(static_cast<std::size_t>(*options_.modes));
    }
    result_.n_modes = static_cast<int>(modes.size());
    const double median = std::abs(modes[modes.size() / 2].s);
    // A median of rounding (rigid-body modes) measures nothing; the pencil's own scale does.
    problem_.s_ref = options_.reference.value_or(reference_share * std::max(median, 1e-6 * spectrum.scale));
    result_.s_ref = problem_.s_ref;
    return std::move(modes);
  }

  bool correct_start(PathPoint& point, const std::vector<StartingMode>& modes) {
    const StageTimer timer(result_.counts.modes_seconds);
    const PencilAtPoint pencil(point.pencil);
    for (const StartingMode& mode : modes) {
      point.modes.push_back(
          correct_mode(pencil, mode.s, mode.z, problem_.s_ref, problem_.corrector, result_.counts.modes));
      const double drift =
          std::abs(point.modes.back().s - mode.s) / std::max(std::abs(mode.s), problem_.s_ref);
      if (point.modes.back().status == ModeStatus::converged && drift < 1e-2) continue;
      std::ostringstream message;
      message << "the mode at s = " << mode.s.real() << " + " << mode.s.imag()
              << "j is not a simple eigenvalue at " << at_parameter(options_, options_.from)
              << "; begin the trace elsewhere, or follow fewer modes";
      return stop(TraceStatus::multiple_mode, message.str());
    }
    if (merged(point)) {
      return stop(TraceStatus::multiple_mode, "two modes coincide at " +
                                                  at_parameter(options_, options_.from) +
                                                  "; begin the trace elsewhere, or follow fewer modes");
    }
    return true;
  }

  /// The loop: propose, compute, judge, keep or try a shorter step.
  void follow() {
    const double range = std::abs(options_.to - options_.from);
    // A step must move p by more than its rounding.
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                            std::max(std::abs(options_.from), std::abs(options_.to));
    const double min_step = std::max(smallest_step * range, rounding);
    const double max_step = std::max(options_.max_step.value_or(0.25 * range), min_step);
    StepControl control(options_.order, options_.first_step.value_or(first_step(range)), max_step, min_step);
    while (node_.p != options_.to) {
      if (result_.nodes >= options_.max_nodes) {
        stop(TraceStatus::too_many_nodes, "stopped after " + std::to_string(result_.nodes) + " points at " +
                                              at_parameter(options_, node_.p) +
                                              "; raise max_nodes or the tolerance");
        return;
      }
      if (!advance(control)) return;
    }
  }

  bool advance(StepControl& control) {
    const double remaining = std::abs(options_.to - node_.p);
    const double h = control.propose(remaining);
    const double p = h == remaining ? options_.to : node_.p + direction_ * h;
    const Prediction prediction = predict(p);
    const PathPoint point = compute_point(problem_, p, prediction, node_.basis, result_.counts);
    double error = INFINITY;
    std::string reason;
    if (acceptable(point, prediction, reason)) {
      error = control.error_from_miss(h, largest_miss(point));
      // An inaccurate step is often known before it is differentiated.
      if (error <= 1.0) {
        auto node = differentiate_point(problem_, point, result_.counts);
        error = node ? std::max(error, error_inside(*node)) : INFINITY;
        if (error <= 1.0) {
          control.accept(h, error);
          previous_ = std::move(node_);
          return keep(std::move(*node));
        }
      }
      ++result_.rejections.inaccurate;
      reason = "the error of the dense output stays above the tolerance";
    }
    control.reject(h, error);
    if (!control.exhausted()) return true;
    return stop(TraceStatus::step_too_small,
                "the step became too small after " + at_parameter(options_, node_.p) + ": " + reason);
  }

  /// Whether the point was computed and its modes are the ones that were predicted.
  bool acceptable(const PathPoint& point, const Prediction& prediction, std::string& reason) {
    if (point.status != PointStatus::computed) {
      ++(point.status == PointStatus::no_equilibrium ? result_.rejections.no_equilibrium
                                                     : result_.rejections.mode_lost);
      reason = point.message;
      return false;
    }
    if (const auto mode = suspicious_match(point, prediction)) {
      ++result_.rejections.mismatch;
      reason = "mode " + std::to_string(*mode + 1) + " is not recognized by its shape";
      return false;
    }
    if (merged(point)) {
      ++result_.rejections.merged;
      reason = "two modes arrived at the same eigenpair";
      return false;
    }
    return true;
  }

  Prediction predict(double p) const {
    const double h = p - node_.p;
    Prediction prediction;
    prediction.equilibrium = {evaluate_series(node_.path.x, h), evaluate_series(node_.path.lambda, h), true};
    prediction.s = evaluate_series(node_.s, h);
    prediction.shapes.resize(node_.path.x.rows(), node_.s.rows());
    for (Eigen::Index i = 0; i < node_.s.rows(); ++i) {
      prediction.shapes.col(i) = evaluate_series(node_.shapes[static_cast<std::size_t>(i)], h);
    }
    return prediction;
  }

  /// Estimated error of the worst mode, given each mode's, as a fraction of what is accepted.
  double relative_error(const ComplexVector& s, const Vector& error) const {
    const auto scale = s.cwiseAbs().cwiseMin(node_.s.col(0).cwiseAbs()).cwiseMax(problem_.s_ref);
    return error.cwiseQuotient(scale).maxCoeff() / (accepted_share(options_.order) * options_.tolerance);
  }

  /// Miss (as a fraction of what is accepted) of the eigenvalues extrapolated from the last step (from the
  /// series, on the first).
  double largest_miss(const PathPoint& point) const {
    const ComplexVector s = point.eigenvalues();
    const ComplexVector expected =
        previous_ ? HermiteInterpolant(previous_->p, previous_->s, node_.p, node_.s)(point.p)
                  : ComplexVector(evaluate_series(node_.s, point.p - node_.p));
    return relative_error(s, (s - expected).cwiseAbs());
  }

  /// From the decay of the interpolant's terms on the step to `next`.
  double error_inside(const PathNode& next) const {
    const HermiteInterpolant step(node_.p, node_.s, next.p, next.s);
    return relative_error(next.s.col(0), step.estimated_error());
  }

  /// The first mode whose shape and place fit another track better than its own, or fit its own badly.
  std::optional<int> suspicious_match(const PathPoint& point, const Prediction& prediction) {
    const StageTimer timer(result_.counts.matching_seconds);
    const ComplexVector s = point.eigenvalues();
    const Matrix assurance =
        modal_assurance(prediction.shapes, point.shapes(), point.equilibrium.linearization.M[0]);
    // Modes may share a shape (the two roots of an overdamped freedom): the distance of the eigenvalues
    // decides then.
    Matrix cost(s.size(), s.size());
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      for (Eigen::Index j = 0; j < s.size(); ++j) {
        const double scale = std::max({std::abs(prediction.s[i]), std::abs(s[j]), problem_.s_ref});
        cost(i, j) = 1.0 - assurance(i, j) + std::abs(prediction.s[i] - s[j]) / scale;
      }
    }
    if (!cost.allFinite()) return 0;
    const std::vector<int> assignment = optimal_assignment(cost);
    for (int i = 0; i < static_cast<int>(s.size()); ++i) {
      if (assignment[static_cast<std::size_t>(i)] != i || assurance(i, i) < least_assurance) return i;
    }
    return std::nullopt;
  }

  bool merged(const PathPoint& point) const {
    const ComplexVector s = point.eigenvalues();
    for (Eigen::Index i = 0; i < s.size(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        if (std::abs(s[i] - s[j]) > merged_distance * std::max(std::abs(s[i]), problem_.s_ref)) continue;
        const ComplexMatrix v = point.shapes();
        const Matrix& mass = point.equilibrium.linearization.M[0];
        if (modal_assurance(v.col(i), v.col(j), mass)(0, 0) > merged_assurance) return true;
      }
    }
    return false;
  }

  /// Length on which the last term of the series stays small: a first step that is rarely rejected.
  double first_step(double range) const {
    const int q = options_.order;
    double step = 0.05 * range;
    for (Eigen::Index i = 0; i < node_.s.rows(); ++i) {
      const double allowed =
          options_.tolerance * std::pow(4.0, q + 1) * std::max(std::abs(node_.s(i, 0)), problem_.s_ref);
      const double last = std::abs(node_.s(i, q));
      if (last > 0.0) step = std::min(step, std::pow(allowed / last, 1.0 / q));
    }
    return std::max(step, 1e-6 * range);
  }

  bool keep(PathNode node) {
    node_ = std::move(node);
    result_.reached = node_.p;
    ++result_.nodes;
    const StageTimer timer(result_.counts.output_seconds);
    if (observer_.node(node_)) return true;
    return stop(TraceStatus::stopped, "stopped on request at " + at_parameter(options_, node_.p));
  }

  bool stop(TraceStatus status, const std::string& message) {
    result_.status = status;
    result_.message = message;
    return false;
  }

  const TraceOptions& options_;
  const TraceObserver& observer_;
  PathProblem problem_;
  TraceResult result_;
  double direction_ = 1.0;
  PathNode node_;                     ///< the last accepted point
  std::optional<PathNode> previous_;  ///< the one before
};

}  // namespace

bool has_started(TraceStatus status) {
  return status == TraceStatus::completed || status == TraceStatus::step_too_small ||
         status == TraceStatus::too_many_nodes || status == TraceStatus::stopped;
}

TraceResult trace(const Model& model, const TraceOptions& options, const TraceObserver& observer,
                  BasisChoice basis) {
  const std::vector<OptionFault> faults = find_faults(options, model.description().parameters);
  if (!faults.empty())
    throw std::invalid_argument("trace: " + faults.front().key + ": " + faults.front().message);
  return Tracer(model, options, observer, basis).run();
}

}  // namespace eigentrail
