#include "continuation/tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "continuation/grouping_errors.hpp"
#include "continuation/regrouping.hpp"
#include "continuation/reparametrize.hpp"
#include "continuation/shared_basis.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/continuation/certificate.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/matching.hpp"

namespace eigentrail {
namespace {

/// A step is accepted up to this share of the tolerance: the estimate leaves out what follows the next term.
constexpr double accepted_share = 0.5;
/// Within a block the eigenvalues count as no closer than this, relatively: at a meeting an error bound for
/// each of them cannot hold, and the block's own functions are what is accurate.
constexpr double least_relative_gap = 0.1;
/// Near a fold eigenvalues vary like the root of the distance in p: p must be known so much better, in units
/// of tolerance times range.
constexpr double parameter_accuracy = 1e-5;
constexpr double smallest_step = 1e-11;     ///< of the range
constexpr double uncertified_step = 1e-6;   ///< of the range: shorter ones are taken without certificate
constexpr double uncertified_error = 30.0;  ///< shortens a step without certificate as much as this error
constexpr double join_reach = 1.0;          ///< steps: meetings nearer than this join modes into a block
/// Single modes whose error is this share of what is accepted limit the step.
constexpr double limiting_error = 0.1;
constexpr double better_chart = 0.3;  ///< the same for the other chart, which costs nothing more
/// A block must be more accurate than its members by this factor to be worth its while.
constexpr double worthwhile = 0.05;
constexpr int most_merges_at_node = 12;
constexpr double large_block_step = 0.05;  ///< of the range: longest step with a block of three or more
/// A diagonal modal assurance below this makes a match suspicious.
constexpr double least_assurance = 0.8;
/// Two tracks closer than this, relatively, with parallel vectors have merged.
constexpr double merged_distance = 1e-8;
constexpr double merged_assurance = 0.999;

}  // namespace

Tracer::Tracer(const Model& model, const TraceOptions& options, const TraceObserver& observer,
               BasisChoice basis)
    : options_(options), observer_(observer), problem_(problem_along(model, options.parameter)) {
  problem_.order = options.order;
  problem_.basis = basis;
  result_.counts.evaluations = model.new_counts();
  direction_ = options.to > options.from ? 1.0 : -1.0;
  uncertified_below_ = uncertified_step * range();
  // The interpolant of order q converges like (h / 2d)^(2q+2) for a meeting at distance d: nearer ones limit
  // the step.
  part_reach_ = 0.7 * std::pow(options.tolerance, -1.0 / (2.0 * options.order + 2.0));
}

TraceResult Tracer::run() {
  const auto begin = std::chrono::steady_clock::now();
  if (start()) follow();
  result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(result_);
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

/// The loop: propose, compute, judge, keep or try a shorter step.
void Tracer::follow() {
  // A step must move p by more than its rounding.
  const double rounding =
      8.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(options_.from), std::abs(options_.to));
  const double min_step = std::max(smallest_step * range(), rounding);
  const double max_step = std::max(options_.max_step.value_or(0.25 * range()), min_step);
  const double begin = options_.first_step.value_or(first_step(node_, problem_, options_.tolerance, range()));
  StepControl control(options_.order, begin, max_step, min_step);
  part(problem_, nullptr, node_, control.step(), 0.0, part_reach_, 0.0, result_.counts);
  while (!reached_end(node_)) {
    if (result_.nodes >= options_.max_nodes) {
      stop(TraceStatus::too_many_nodes, "stopped after " + std::to_string(result_.nodes) + " points at " +
                                            at_parameter(node_.p) + "; raise max_nodes or the tolerance");
      return;
    }
    if (!advance(control)) return;
    if (turned_step_ > 0.0) {
      // In the path's own coordinate the range has length one.
      const double longest = options_.max_step ? *options_.max_step / range() : 0.25;
      control = StepControl(options_.order, turned_step_, std::max(longest, smallest_step), smallest_step);
      turned_step_ = 0.0;
    }
  }
}

bool Tracer::advance(StepControl& control) {
  const double length = control.propose(std::min(remaining(), longest_allowed_step()));
  double h = direction_ * length;
  std::optional<PathNode> next;
  double error = 0.0;
  Trouble trouble = attempt(h, next);
  if (bridge_branch_point(h, trouble ? nullptr : &*next)) return true;
  if (!trouble) trouble = judge(h, *next, error);
  if (trouble) {
    if (remedy(trouble, h, next)) return true;
    if (trouble.kind == Trouble::Kind::uncertified && length <= uncertified_below_) {
      trouble = {};  // taken as it is, and marked
    } else {
      control.reject(length, trouble.kind == Trouble::Kind::uncertified ? uncertified_error : trouble.error);
      return control.exhausted() ? give_up(trouble) : true;
    }
  }
  if (!land_on_end(h, next) || !land_on_fold(h, next) || !land_on_meeting(h, next)) {
    control.reject(length, INFINITY);
    return control.exhausted() ? give_up(trouble) : true;
  }
  control.accept(length, error);
  return accept(h, std::move(*next), control.step());
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

Tracer::Trouble Tracer::attempt(double h, std::optional<PathNode>& next) {
  const PathPoint point = compute_point(problem_, predict(node_, h), node_.basis.T[0], result_.counts);
  if (point.status == PointStatus::no_equilibrium)
    return {Trouble::Kind::no_equilibrium, -1, INFINITY, point.message};
  if (point.status == PointStatus::mode_lost)
    return {Trouble::Kind::mode_lost, point.lost_track, INFINITY, point.message};
  next = differentiate_point(problem_, point, result_.counts);
  if (!next) return {Trouble::Kind::mode_lost, -1, INFINITY, "a series is not finite"};
  label_arrival(h, *next);
  return {};
}

Tracer::Trouble Tracer::judge(double h, const PathNode& next, double& error) {
  certified_.assign(node_.tracks.size(), false);
  if (Trouble trouble = check_path(h, next)) return trouble;
  const Trouble inaccuracy = measure_error(h, next);
  error = inaccuracy.error;
  if (error > 1.0) return inaccuracy;
  if (Trouble trouble = check_identity(next)) return trouble;
  return options_.certify ? certify(h, next) : Trouble{};
}

double Tracer::track_error(double h, const PathNode& next, std::size_t i) const {
  const Track& track = node_.tracks[i];
  const DenseBlock block = block_on_step(node_, next, i);
  const HermiteInterpolant step(h, block.left, block.right);
  const Vector errors = (step.error_without_last() - function_rounding(track.pair.Lambda)).cwiseMax(0.0);
  double worst = 0.0;
  for (const double t : {0.0, 0.5, 1.0}) {
    const ComplexVector functions = step(t);
    const double size = block_roots(functions).cwiseAbs().mean();
    const double scale = std::max(size, problem_.reference(track.pair.chart));
    const double error = root_error(functions, errors, least_relative_gap * scale) /
                         (accepted_share * options_.tolerance * scale);
    worst = std::isfinite(error) ? std::max(worst, error) : INFINITY;
  }
  return worst;
}

/// The worst estimated error of the dense output on the step, as a fraction of what is accepted.
Tracer::Trouble Tracer::measure_error(double h, const PathNode& next) const {
  Trouble worst{Trouble::Kind::inaccurate, -1, 0.0,
                "the error of the dense output stays above the tolerance"};
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) {
    const double error = track_error(h, next, i);
    if (error <= worst.error) continue;
    worst.error = error;
    worst.track = static_cast<int>(i);
  }
  if (plane_) {
    const auto row = [&](const PathNode& node) {
      return ComplexMatrix(node.path.parameters.row(problem_.traced).cast<Complex>());
    };
    const double error = HermiteInterpolant(h, row(node_), row(next)).error_without_last()[0] /
                         (parameter_accuracy * options_.tolerance * range());
    if (error > worst.error)
      worst = {Trouble::Kind::inaccurate, -1, error, "the parameter along the path is inaccurate"};
  }
  return worst;
}

/// The partners with which a track on the step to `next`, whose error is `error`, would be so much more
/// accurate as a block that it is worth its while; empty when nobody helps. The nearest alone, or with those
/// after it.
std::vector<Partner> Tracer::helpful_partners(double h, const PathNode& next, std::size_t track, double error,
                                              std::vector<Partner> candidates) const {
  const Track& there = next.tracks[track];
  const double scale = std::max(there.roots.cwiseAbs().mean(), problem_.reference(there.pair.chart));
  const double accepted = accepted_share * options_.tolerance * scale;
  std::vector<Partner> chosen;
  // Larger blocks are told less well, and hold more that may happen at once: only where steps keep shrinking.
  const bool shrinking = std::abs(h) < 0.25 * longest_step_;
  for (const Partner& candidate : candidates) {
    Eigen::Index size = there.size();
    for (const Partner& partner : chosen) size += next.tracks[partner.track].size();
    if (size + (candidate.track < next.tracks.size() ? next.tracks[candidate.track].size() : 0) > 2 &&
        !shrinking)
      break;
    if (candidate.track >= next.tracks.size() || chosen.size() > 4) break;
    // Those that are met farther away hardly matter, and larger blocks cost digits.
    if (candidate.distance > 1.5 * candidates.front().distance) break;
    chosen.push_back(candidate);
    const double together = error_as_block(node_, next, track, chosen, h, least_relative_gap * scale);
    if (together <= worthwhile * error * accepted) return chosen;
  }
  return {};
}

void Tracer::join_limiting_modes(double h, PathNode& next, double next_step) {
  for (std::size_t i = 0; i < next.tracks.size() && i < node_.tracks.size(); ++i) {
    if (next.tracks[i].size() > 1 || node_.tracks[i].size() > 1) continue;
    const double error = track_error(h, next, i);
    if (error < limiting_error) continue;
    const double in_other_chart = error_in_other_chart(problem_, node_, next, i, h);
    if (in_other_chart < better_chart * error * accepted_share * options_.tolerance) {
      if (change_chart(problem_, next, i, result_.counts)) ++result_.regroupings.charts;
      continue;
    }
    const auto partners =
        helpful_partners(h, next, i, error, find_partners(next, i, direction_ * next_step, part_reach_));
    if (partners.empty() || !join(problem_, next, i, partners, result_.counts)) continue;
    ++result_.regroupings.joined;
    return;  // joining reorders the tracks; the next point looks again
  }
}

/// Modes may not arrive at the same eigenpair, and without a certificate their shapes must resemble those at
/// the beginning of the step.
Tracer::Trouble Tracer::check_identity(const PathNode& next) {
  const StageTimer timer(result_.counts.matching_seconds);
  const Matrix& mass = next.linearization.M[0];
  for (std::size_t i = 0; i < next.tracks.size(); ++i) {
    const Track& a = next.tracks[i];
    if (a.size() > 1) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const Track& b = next.tracks[j];
      if (b.pair.chart != a.pair.chart) continue;
      for (Eigen::Index k = 0; k < b.size(); ++k) {
        const double distance = std::abs(a.roots[0] - b.roots[k]);
        if (distance > merged_distance * std::max(std::abs(a.roots[0]), problem_.reference(a.pair.chart)))
          continue;
        const bool parallel =
            b.size() > 1 || modal_assurance(a.series.Z[0], b.series.Z[0], mass)(0, 0) > merged_assurance;
        if (parallel) {
          return {Trouble::Kind::merged, static_cast<int>(i), INFINITY,
                  "two modes arrived at the same eigenpair"};
        }
      }
    }
    if (options_.certify) continue;
    const double assurance = modal_assurance(a.series.Z[0], node_.tracks[i].series.Z[0], mass)(0, 0);
    if (assurance < least_assurance) {
      return {Trouble::Kind::mismatch, static_cast<int>(i), INFINITY,
              "a mode is not recognized by its shape"};
    }
  }
  return {};
}

Tracer::Trouble Tracer::certify(double h, const PathNode& next) {
  const StepPencil pencil(node_, next, h);
  Trouble trouble;
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) {
    const Track& track = node_.tracks[i];
    double gap = INFINITY;
    for (const Complex root : track.roots) {
      if (!track.pair.is_real) gap = std::min(gap, 2.0 * std::abs(root.imag()));
      for (std::size_t j = 0; j < node_.tracks.size(); ++j) {
        const Track& other = node_.tracks[j];
        if (j == i || other.pair.chart != track.pair.chart) continue;
        for (const Complex s : other.roots) gap = std::min(gap, std::abs(s - root));
      }
    }
    certified_[i] = certify_step(pencil, track, next.tracks[i], gap, result_.counts);
    if (certified_[i] || trouble) continue;
    trouble = {Trouble::Kind::uncertified, static_cast<int>(i), INFINITY, "the certificate does not close"};
    // On a longer step the others are not looked at: it will not be taken.
    if (std::abs(h) > uncertified_below_) return trouble;
  }
  return trouble;
}

bool Tracer::remedy(const Trouble& trouble, double h, const std::optional<PathNode>& next) {
  Rejections& rejections = result_.rejections;
  switch (trouble.kind) {
    case Trouble::Kind::no_equilibrium:
      ++rejections.no_equilibrium;
      return turn_to_plane(h);
    case Trouble::Kind::mode_lost:
      ++rejections.mode_lost;
      break;
    case Trouble::Kind::inaccurate:
      ++rejections.inaccurate;
      break;
    case Trouble::Kind::mismatch:
      ++rejections.mismatch;
      break;
    case Trouble::Kind::merged:
      ++rejections.merged;
      break;
    case Trouble::Kind::uncertified:
      ++rejections.uncertified;
      break;
    case Trouble::Kind::none:
      return false;
  }
  if (turn_to_plane(h)) return true;
  if (trouble.track < 0) return false;
  const auto track = static_cast<std::size_t>(trouble.track);
  if (prefers_other_chart(node_.tracks[track], h) && change_chart(problem_, node_, track, result_.counts)) {
    ++result_.regroupings.charts;
    return true;
  }
  if (merges_at_node_ >= most_merges_at_node) return false;
  std::vector<Partner> partners = find_partners(node_, track, h, join_reach);
  if (trouble.kind == Trouble::Kind::inaccurate && next) {
    partners = helpful_partners(h, *next, track, trouble.error, find_partners(node_, track, h, part_reach_));
  } else if (partners.size() > 1) {
    partners.resize(1);
  }
  if (partners.empty()) return false;
  ++merges_at_node_;
  if (!join(problem_, node_, track, partners, result_.counts)) return false;
  ++result_.regroupings.joined;
  return true;
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

bool Tracer::give_up(const Trouble& trouble) {
  std::string who;
  if (trouble.track >= 0) {
    for (const int mode : node_.tracks[static_cast<std::size_t>(trouble.track)].modes) {
      if (mode >= 0) who += (who.empty() ? "mode " : ", ") + std::to_string(mode + 1);
    }
  }
  return stop(TraceStatus::step_too_small, "the step became too small after " + at_parameter(node_.p) + ": " +
                                               (who.empty() ? who : who + ": ") + trouble.reason);
}

bool Tracer::stop(TraceStatus status, const std::string& message) {
  result_.status = status;
  result_.message = message;
  return false;
}

}  // namespace eigentrail
