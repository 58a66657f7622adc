#include "continuation/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "continuation/continued_mode.hpp"
#include "continuation/regrouping.hpp"
#include "core/matrix_series.hpp"
#include "core/parallel.hpp"
#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {
namespace {

constexpr double smallest_step = 1e-11;     ///< of the range
constexpr double uncertified_step = 1e-6;   ///< of the range: shorter ones are taken without certificate
constexpr double uncertified_error = 30.0;  ///< shortens a step without certificate as much as this error
constexpr double series_share = 1e-5;       ///< accuracy of the coefficients of a series / tolerance
constexpr double passing_share = 0.01;      ///< error of a mode that is not corrected / tolerance
constexpr double far_from_axis = 100.0;     ///< |Re s| / error, and |s| / what counts as zero
constexpr double far_from_others = 2.0;     ///< meetings of modes that pass / those that divide blocks
constexpr double large_block_step = 0.05;   ///< of the range: longest step with a block of three or more
constexpr double singular_angle = 1e-3;     ///< rad: constraints this close to each other explain a lot

}  // namespace

Tracer::Tracer(const Model& model, const TraceOptions& options, const TraceObserver& observer,
               BasisChoice basis)
    : options_(options), observer_(observer), problem_(problem_along(model, options.parameter)) {
  for (const auto& [name, value] : options.values)
    problem_.parameters[model.description().parameters.index(name).value()] = value;
  problem_.basis = basis;
  problem_.threads = options.threads;
  problem_.corrector.passing_error = passing_share * options.tolerance;
  problem_.corrector.series_accuracy = std::max(series_share * options.tolerance, 1e-15);
  criteria_ = criteria_of(options.events);
  result_.counts.evaluations = model.new_counts();
  direction_ = options.to > options.from ? 1.0 : -1.0;
  uncertified_below_ = uncertified_step * range();
}

TraceResult Tracer::run() {
  if (start()) {
    prepare_to_follow();
    follow();
  }
  result_.seconds = seconds_so_far();
  return std::move(result_);
}

double Tracer::seconds_so_far() const {
  return seconds_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::string Tracer::at_parameter(double p) const {
  std::ostringstream text;
  text.precision(12);
  text << options_.parameter << " = " << p;
  return text.str();
}

namespace {

/// Length on which the last term of the series stays small: a first step that is rarely rejected.
double first_step(const PathNode& node, const PathProblem& problem, double tolerance, double range) {
  const int q = problem.order;
  double step = 0.05 * range;
  for (const Track& track : node.tracks) {
    const double allowed = tolerance * std::pow(4.0, q + 1) *
                           std::max(std::abs(track.functions(0, 0)), problem.reference(track.pair.chart));
    const double last = std::abs(track.functions(0, q));
    if (last > 0.0) step = std::min(step, std::pow(allowed / last, 1.0 / q));
  }
  return std::max(step, 1e-6 * range);
}

}  // namespace

void Tracer::prepare_to_follow() {
  // A step must move p by more than its rounding.
  const double rounding =
      8.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(options_.from), std::abs(options_.to));
  const double min_step = std::max(smallest_step * range(), rounding);
  const double max_step = std::max(options_.max_step.value_or(0.25 * range()), min_step);
  const double begin = options_.first_step.value_or(first_step(node_, problem_, options_.tolerance, range()));
  control_ = StepControl(problem_.order, begin, max_step, min_step);
  part(problem_, nullptr, node_, control_.step(), 0.0, part_reach_, 0.0, result_.counts);
}

/// The loop: propose, compute, judge, keep or try a shorter step.
void Tracer::follow() {
  while (!reached_end(node_)) {
    if (result_.nodes >= options_.max_nodes) {
      stop(TraceStatus::too_many_nodes, "stopped after " + std::to_string(result_.nodes) + " points at " +
                                            at_parameter(node_.p) + "; raise max_nodes or the tolerance");
      return;
    }
    // They served the point; what follows begins from series.
    for (Track& track : node_.tracks) track.pair.factors.reset();
    result_.seconds = seconds_so_far();
    if (!observer_.checkpoint(*this)) {
      stop(TraceStatus::stopped, "stopped on request at " + at_parameter(node_.p));
      return;
    }
    if (!advance()) return;
    if (turned_step_ > 0.0) {
      // In the path's own coordinate the range has length one.
      const double longest = options_.max_step ? *options_.max_step / range() : 0.25;
      control_ = StepControl(problem_.order, turned_step_, std::max(longest, smallest_step), smallest_step);
      turned_step_ = 0.0;
    }
  }
}

bool Tracer::advance() {
  const double length = control_.propose(std::min(remaining(), longest_allowed_step()));
  double h = direction_ * length;
  std::optional<PathNode> next;
  double error = 0.0;
  Trouble trouble = attempt(h, next);
  if (bridge_branch_point(h, trouble ? nullptr : &*next)) return true;
  if (!trouble) trouble = judge(h, *next, error);
  if (trouble) {
    if (remedy(trouble, h, next)) {
      tried_ = std::move(next);
      tried_step_ = plane_ ? 0.0 : h;
      return true;
    }
    if (trouble.kind == Trouble::Kind::uncertified && length <= uncertified_below_) {
      trouble = {};  // taken as it is, and marked
    } else {
      control_.reject(length, trouble.kind == Trouble::Kind::uncertified ? uncertified_error : trouble.error);
      return control_.exhausted() ? give_up(trouble) : true;
    }
  }
  if (!land_on_end(h, next) || !land_on_fold(h, next) || !land_on_meeting(h, next)) {
    control_.reject(length, INFINITY);
    return control_.exhausted() ? give_up(trouble) : true;
  }
  control_.accept(length, error);
  return accept(h, std::move(*next), control_.step());
}

/// More than one meeting may hide in a long step of a large block.
double Tracer::longest_allowed_step() const {
  const bool large =
      std::any_of(node_.tracks.begin(), node_.tracks.end(), [](const Track& t) { return t.size() > 2; });
  return large ? large_block_step * (plane_ ? 1.0 : range()) : std::numeric_limits<double>::max();
}

Prediction Tracer::predict(const PathNode& base, double h) const {
  Prediction prediction;
  const Vector parameters = evaluate_series(base.path.parameters, h);
  prediction.p = parameters[problem_.traced];
  // The end of the range is met exactly.
  if (!plane_ && std::abs(prediction.p - options_.to) <= 1e-14 * range() + 1e-15 * std::abs(options_.to))
    prediction.p = options_.to;
  prediction.equilibrium = {evaluate_series(base.path.x, h), evaluate_series(base.path.lambda, h), true};
  prediction.plane = plane_;
  if (bridge_) keep_to_bridge(prediction);
  for (const Track& track : base.tracks) {
    InvariantPair pair;
    pair.chart = track.pair.chart;
    pair.is_real = track.pair.is_real;
    pair.Z = evaluate_series(track.series.Z, h);
    pair.Lambda = evaluate_series(track.series.Lambda, h);
    prediction.pairs.push_back(std::move(pair));
  }
  return prediction;
}

/// Events want eigenvalues to their own digits: modes near one are corrected at every point.
bool Tracer::is_far_from_events(const ContinuedMode& mode, std::size_t track, double h) const {
  const Complex mu = mode.pair.Lambda(0, 0);
  const double error = problem_.corrector.passing_error * std::abs(mu);
  return std::abs(mu.real()) > far_from_axis * error &&
         std::abs(mu) > far_from_axis * problem_.reference(mode.pair.chart) &&
         find_partners(node_, track, h, far_from_others * part_reach_).empty();
}

Prediction Tracer::predict_all(double h) {
  Prediction prediction = predict(node_, h);
  for (Track& track : node_.tracks) {
    if (track.strand == 0) track.strand = ++strands_;
  }
  const std::size_t count = node_.tracks.size();
  prediction.ready.assign(count, nullptr);
  for (std::size_t i = 0; tried_ && tried_step_ == h && i < count; ++i) {
    for (const Track& other : tried_->tracks) {
      if (other.strand == node_.tracks[i].strand) prediction.ready[i] = &other;
    }
  }
  // Where all modes are corrected at once none of them is spared.
  if (problem_.route == ModeRoute::one_by_one && !plane_ && last_step_ != 0.0) {
    prediction.continued.resize(count);
    const int threads = is_worth_sharing(count, node_.pencil.size()) ? problem_.threads : 1;
    in_parallel(count, threads, [&](std::size_t i) {
      if (prediction.ready[i] != nullptr) return;
      prediction.continued[i] = continue_mode(previous_, node_, i, last_step_, h);
    });
    prediction.may_pass = [this, h](const ContinuedMode& mode, std::size_t i) {
      return is_far_from_events(mode, i, h);
    };
  }
  return prediction;
}

Tracer::Trouble Tracer::attempt(double h, std::optional<PathNode>& next) {
  const PathPoint point = compute_point(problem_, predict_all(h), node_.basis.T[0], result_.counts);
  if (point.status == PointStatus::no_equilibrium)
    return {Trouble::Kind::no_equilibrium, -1, INFINITY, point.message};
  if (point.status == PointStatus::mode_lost)
    return {Trouble::Kind::mode_lost, point.lost_track, INFINITY, point.message};
  next = differentiate_point(problem_, point, result_.counts);
  if (!next) return {Trouble::Kind::mode_lost, -1, INFINITY, "a series is not finite"};
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) next->tracks[i].strand = node_.tracks[i].strand;
  label_arrival(h, *next);
  return {};
}

bool Tracer::accept(double h, PathNode next, double next_step) {
  find_events(h, next);
  const PathStep step = make_step(h, next);
  complete(next);
  for (const DenseBlock& block : step.blocks) {
    result_.mode_steps += static_cast<long>(block.modes.size());
    if (block.certified) result_.certified_steps += static_cast<long>(block.modes.size());
  }
  const bool go_on = emit(next, &step);
  for (Track& track : next.tracks) track.arriving = track.modes;
  if (leaves_path_at(next)) {
    node_ = std::move(next);
    return go_on && leave_path(choice_at(branch_points_++));
  }
  if (on_branch_point(coordinate(next.path.x.col(0), next.p))) ++branch_points_;
  const std::size_t before = next.tracks.size();
  part(problem_, &node_, next, next_step, h, part_reach_, accepted_share * options_.tolerance,
       result_.counts);
  result_.regroupings.parted += static_cast<int>(next.tracks.size() - std::min(before, next.tracks.size()));
  if (next.tracks.size() == before) join_limiting_modes(h, next, next_step);
  longest_step_ = std::max(std::abs(h), 0.85 * longest_step_);
  previous_ = std::move(node_);
  last_step_ = plane_ ? 0.0 : h;
  tried_.reset();
  node_ = std::move(next);
  merges_at_node_ = 0;
  bridges_tried_ = 0;
  renew_plane();
  turn_to_plane(direction_ * next_step);
  return go_on;
}

bool Tracer::emit(const PathNode& node, const PathStep* step) {
  result_.reached = node.p;
  ++result_.nodes;
  const StageTimer timer(result_.counts.output_seconds);
  if (observer_.point({node, mode_states(node), step})) return true;
  return stop(TraceStatus::stopped, "stopped on request at " + at_parameter(node.p));
}

namespace {

/// Links that come to lie in one line take the mechanism to where its freedoms change, and the path ends.
std::string remark_on_constraints(const PathNode& node) {
  const double angle = ConstraintFactorization(node.linearization.A[0]).independence();
  if (angle > singular_angle) return {};
  std::ostringstream text;
  text.precision(2);
  text << "; the constraints come to depend on each other (least angle " << angle
       << " rad), as where links of a mechanism lie in one line";
  return text.str();
}

/// Beside zero the tolerance asks for more than rounding leaves where next to nothing counts as zero, as when
/// all modes are slow where the trace begins.
std::string remark_on_zero(const Track& track, double reference) {
  constexpr double near = 100.0;
  if (track.pair.chart != Chart::finite || !(track.roots.cwiseAbs().minCoeff() < near * reference)) return {};
  std::ostringstream text;
  text.precision(3);
  text << "; beside zero rounding exceeds tolerance * reference: give a larger `reference`, now " << reference
       << " 1/s";
  return text.str();
}

}  // namespace

bool Tracer::give_up(const Trouble& trouble) {
  std::string who;
  if (trouble.track >= 0) {
    for (const int mode : node_.tracks[static_cast<std::size_t>(trouble.track)].modes) {
      if (mode >= 0) who += (who.empty() ? "mode " : ", ") + std::to_string(mode + 1);
    }
  }
  std::string remarks = remark_on_constraints(node_);
  if (trouble.kind == Trouble::Kind::inaccurate && trouble.track >= 0) {
    remarks += remark_on_zero(node_.tracks[static_cast<std::size_t>(trouble.track)], problem_.s_ref);
  }
  return stop(TraceStatus::step_too_small, "the step became too small after " + at_parameter(node_.p) + ": " +
                                               (who.empty() ? who : who + ": ") + trouble.reason + remarks);
}

bool Tracer::stop(TraceStatus status, const std::string& message) {
  result_.status = status;
  result_.message = message;
  return false;
}

}  // namespace eigentrail
