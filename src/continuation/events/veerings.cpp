#include "continuation/events/veerings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "continuation/events/complex_interpolant.hpp"
#include "continuation/events/event_record.hpp"
#include "continuation/events/expected_meetings.hpp"
#include "continuation/events/veering_partners.hpp"
#include "continuation/events/walk.hpp"
#include "continuation/tracks/members.hpp"
#include "continuation/tracks/regrouping.hpp"
#include "core/matrix_series.hpp"
#include "eigentrail/modes/block_parts.hpp"
#include "eigentrail/modes/invariants.hpp"
#include "eigentrail/modes/regroup.hpp"

namespace eigentrail {
namespace {

using ComplexSight = Sight<Complex>;

/// As a share of the range: accuracy to which exceptional points beside the axis are located.
constexpr double resolution_share = 1e-10;
/// In units of the resolution. Moves up to this length that no longer shrink end the walk. For half-widths up
/// to this the error estimate does not end the walk, since the conjugate root is so close that it makes the
/// estimate unreliable.
constexpr double loose = 100.0;
/// Relative increase of the largest half-width, so that a veering exactly on the limit is found.
constexpr double limit_rounding = 1e-9;
/// In units of the largest half-width: iterates may be this far off the axis ...
constexpr double off_axis_on_the_way = 2.0;
/// ... and, in units of that distance, a single move may be this long.
constexpr double walks_as_far = 3.0;
/// Largest number of iterations; each computes between one and five points.
constexpr int most_rounds = 6;
/// Iterations after which moves must shrink: the first ones use inaccurate predictions.
constexpr int free_rounds = 2;
/// In units of the largest distance off the axis: least distance of the points on both sides of the root.
constexpr double least_width = 1e-6;
/// Smallest |dp/dsigma| by which a half-width in p is converted to the path's coordinate. Near a fold, where
/// dp/dsigma vanishes, the search would otherwise become too wide.
constexpr double least_speed = 1e-3;
/// Largest half-width of the search, in units of the range.
constexpr double widest_search = 2.0;

/// Half-width up to which veerings are searched for, in the coordinate along the path.
double search_width(const EventSearch& search, const PathNode& node) {
  const PathFrame& frame = search.frame();
  const double range = frame.range.length();
  const double speed = frame.plane ? std::abs(frame.speed(node)) : 1.0;
  const double widest = search.thresholds().veering.widest * (1.0 + limit_rounding);
  return std::min(widest * range / std::max(speed, least_speed), widest_search * range);
}

/// Whether a power series confirms a root of the interpolant: there, the last term and the sum of all terms
/// are at most `trusted_share` of the largest term.
bool confirms_root(const ComplexVector& series, Complex root, double trusted_share) {
  double largest = 0.0;
  Complex term = 0.0;
  Complex sum = 0.0;
  Complex power = 1.0;
  for (const Complex coefficient : series) {
    term = coefficient * power;
    sum += term;
    largest = std::max(largest, std::abs(term));
    power *= root;
  }
  return std::abs(term) <= trusted_share * largest && std::abs(sum) <= trusted_share * largest;
}

/// The discriminant from its series at both ends of a step of length h. An end close to the predicted root is
/// left out: the walk adds points there, and points of an interpolant that nearly coincide cause rounding
/// errors.
ComplexInterpolant discriminant_from_ends(const ExpectedMeeting& expected, double h) {
  constexpr double next_to = 0.02;  // share of the step
  ComplexInterpolant discriminant;
  const auto add = [&](double position, const ComplexVector& series) {
    const bool far = std::abs(position - expected.position.real()) > next_to * std::abs(h);
    if (series.size() > 0 && far) discriminant.add(position, series);
  };
  add(0.0, expected.discriminant_at_left);
  add(h, expected.discriminant_at_right);
  return discriminant;
}

/// Series of the sum of the eigenvalues of a track.
ComplexVector sum_of_roots(const Track& track) {
  return static_cast<double>(track.size()) * mean_series(track.series.Lambda);
}

/// Whether the corrector has converged to other modes than those that were predicted: the sum of the
/// eigenvalues of `to` differs from the series of the sum at `from`, over a distance, by more than its
/// truncation error.
bool has_jumped(const PathProblem& problem, const std::vector<const Track*>& from, const Track& to,
                double distance) {
  constexpr double safety = 10.0;    // on the estimated truncation error
  constexpr double no_drift = 1e-6;  // relative difference that is always allowed
  ComplexVector trace = sum_of_roots(*from.front());
  for (std::size_t i = 1; i < from.size(); ++i) trace += sum_of_roots(*from[i]);
  const double step = std::abs(distance);
  if (step == 0.0) return false;
  const Complex expected = evaluate_series(ComplexMatrix(trace.transpose()), distance)[0];
  const Eigen::Index last = trace.size() - 1;
  // The larger of the last two terms, since one of them may be small by chance.
  const double uncertain = std::pow(step, static_cast<double>(last)) *
                           std::max(std::abs(trace[last]), std::abs(trace[last - 1]) / step);
  const double drift = std::abs(sum_of_roots(to)[0] - expected);
  return drift > safety * uncertain + no_drift * std::max(std::abs(expected), problem.s_ref);
}

/// Locates one predicted veering. The two eigenvalues are computed as one block at real points near the
/// exceptional point; the complex root of their discriminant follows from its series at these points.
class VeeringWalk {
 public:
  VeeringWalk(const EventSearch& search, const Step& step, const ExpectedMeeting& expected,
              std::vector<int> modes)
      : search_(search), step_(step), expected_(expected), modes_(std::move(modes)) {}

  FoundEvents run();

 private:
  std::optional<PathNode> as_one_block() const;
  std::optional<PathNode> in_its_block(const PathNode& nearer, double distance) const;
  std::optional<PathNode> joined(const TracksAt& apart, double distance) const;
  std::optional<PathNode> follow(const TracksAt& base, double distance) const;
  bool look_from(double where, ComplexInterpolant& discriminant);
  ComplexSight look(Complex root);
  Event event_at(Complex root) const;
  bool counts(const Event& event, Complex root) const;
  ComplexVector discriminant_at(const PathNode& node) const {
    return discriminant_series(node.tracks.front().series.Lambda,
                               static_cast<Eigen::Index>(expected_.a.members.size()));
  }

  const EventSearch& search_;
  const Step& step_;
  const ExpectedMeeting& expected_;
  std::vector<int> modes_;
  std::optional<PathNode> base_;   ///< the block at the real part of the predicted root
  std::optional<PathNode> below_;  ///< the block at the last real point
  double position_ = 0.0;          ///< of the last real point, as a distance from the left end
  ComplexInterpolant discriminant_;
  /// Largest distance of iterates from the real axis, and accuracy, in the coordinate along the path.
  double widest_ = 0.0, resolution_ = 0.0;
  int looks_ = 0, rounds_ = 0;
};

/// The tracks at a distance; empty if the corrector failed or converged to other modes.
std::optional<PathNode> VeeringWalk::follow(const TracksAt& base, double distance) const {
  std::optional<SolvedPoint> there = search_.solver.follow(base, distance);
  if (!there || has_jumped(search_.problem(), base.tracks, there->node.tracks.front(), distance))
    return std::nullopt;
  return std::move(there->node);
}

/// Two tracks as one block at a distance; empty as above.
std::optional<PathNode> VeeringWalk::joined(const TracksAt& apart, double distance) const {
  Prediction prediction = search_.solver.predict(apart, distance);
  const InvariantPair& a = prediction.pairs[0];
  const InvariantPair& b = prediction.pairs[1];
  InvariantPair pair = join_pairs({&a, &b}, a.is_real || b.is_real);
  // A real mode joined with a complex one would need the conjugate, too. Such modes cannot veer.
  if (pair.size() != a.size() + b.size()) return std::nullopt;
  prediction.pairs = {std::move(pair)};
  std::optional<SolvedPoint> there = search_.solver.solve(prediction, apart.node.basis.T[0]);
  if (!there || has_jumped(search_.problem(), apart.tracks, there->node.tracks.front(), distance))
    return std::nullopt;
  return std::move(there->node);
}

/// The point at a distance with the two eigenvalue branches as a block, if both belong to one track, which
/// may have more eigenvalues.
std::optional<PathNode> VeeringWalk::in_its_block(const PathNode& nearer, double distance) const {
  const std::size_t index = expected_.a.track;
  std::optional<PathNode> point = follow(one_track(nearer, index), distance);
  if (!point) return std::nullopt;
  const std::vector<int> members = united(expected_.a.members, expected_.b.members);
  Track& block = point->tracks.front();
  if (static_cast<Eigen::Index>(members.size()) == block.size()) return point;
  // Separate the two from a larger block, where they are closer to each other than to the others.
  EigenvalueSampler branches(*step_.left, step_.right, index, step_.h);
  const double share = std::clamp(expected_.position.real() / step_.h, 0.0, 1.0);
  block.roots = in_order_of(branches(share), block.roots);
  std::optional<Track> pair = separate(search_.problem(), *point, block, members, search_.solver.counts());
  if (!pair) return std::nullopt;
  point->tracks = {std::move(*pair)};
  return point;
}

/// The real point at the predicted position, with the two eigenvalue branches as one block as its only track.
std::optional<PathNode> VeeringWalk::as_one_block() const {
  const EigenvalueBranch& a = expected_.a;
  const EigenvalueBranch& b = expected_.b;
  const bool right = expected_.position.real() / step_.h > 0.5;
  const PathNode& nearer = right ? step_.right : *step_.left;
  const double distance = expected_.position.real() - (right ? step_.h : 0.0);
  if (a.track == b.track) return in_its_block(nearer, distance);
  std::vector<Track> apart;
  for (const EigenvalueBranch* branch : {&a, &b}) {
    std::optional<Track> track = separate(search_.problem(), nearer, nearer.tracks[branch->track],
                                          branch->members, search_.solver.counts());
    if (!track) return std::nullopt;
    apart.push_back(std::move(*track));
  }
  return joined({nearer, {&apart[0], &apart[1]}}, distance);
}

/// Computes the block at a real place and adds its discriminant to an interpolant. False if that fails.
bool VeeringWalk::look_from(double where, ComplexInterpolant& discriminant) {
  const double distance = where - expected_.position.real();
  position_ = where;
  below_ = distance == 0.0 ? base_ : follow(all_tracks(*base_), distance);
  ++looks_;
  if (!below_) return false;
  discriminant.add(where, discriminant_at(*below_));
  return true;
}

/// One iteration: the complex root from the series at the real part of `root` and, from the second iteration
/// on, at points on both sides of it, as far away as the root is off the axis. In the first iteration the
/// ends of the step take the place of these points.
ComplexSight VeeringWalk::look(Complex root) {
  const double width = std::max(std::abs(root.imag()), least_width * widest_);
  ComplexInterpolant around;
  const auto look_beside = [&](double offset) {
    // If there is no point at that distance, one may be found half as far away.
    return look_from(root.real() + offset, around) || look_from(root.real() + 0.5 * offset, around);
  };
  const bool seen = rounds_ > 0 && look_beside(-width) && look_beside(width);
  ++rounds_;
  discriminant_ = seen ? around : discriminant_from_ends(expected_, step_.h);
  if (!look_from(root.real(), discriminant_)) return {ComplexSight::Kind::failed};
  const Complex refined = discriminant_.root_near(root, width);
  const Complex move = refined - root;
  if (!(std::abs(refined.imag()) < widest_ && std::abs(move) < walks_as_far * widest_))
    return {ComplexSight::Kind::failed};
  const double error = discriminant_.error_of_root(refined, resolution_);
  const double speed = search_.frame().speed(*step_.left);
  const Complex p(step_.left->p + refined.real() * speed, refined.imag() * speed);
  // The veering is recorded already, or certainly too wide.
  if (search_.log.knows_veering(p, modes_)) return {ComplexSight::Kind::absent};
  if (std::abs(refined.imag()) - error > widest_ / off_axis_on_the_way) return {ComplexSight::Kind::absent};
  const bool narrow = std::abs(refined.imag()) <= loose * resolution_;
  const bool settled = !narrow && error <= resolution_;
  return {settled ? ComplexSight::Kind::settled : ComplexSight::Kind::seen, move};
}

Event VeeringWalk::event_at(Complex root) const {
  const double offset = root.real() - position_;
  const double speed = search_.frame().speed(*below_);
  const Track& there = below_->tracks.front();
  Event event;
  event.kind = EventKind::veering;
  event.half_width = std::abs(root.imag() * speed);
  event.p = below_->p + offset * speed;
  const ComplexMatrix mean = mean_series(there.series.Lambda).transpose();
  event.s = chart_value(evaluate_series(mean, offset)[0], there.pair.chart);
  event.modes = modes_;
  event.node = search_.node;
  event.retrackings = looks_;
  return event;
}

/// Whether the root is a veering: not a double root of the discriminant, confirmed by the series at its real
/// part, and neither too wide nor narrower than the resolution, or than rounding may open a crossing to. The
/// series does not confirm a root if another exceptional point is as close.
bool VeeringWalk::counts(const Event& event, Complex root) const {
  const VeeringThresholds& thresholds = search_.thresholds().veering;
  const double widest = thresholds.widest * (1.0 + limit_rounding) * search_.frame().range.length();
  const ComplexVector discriminant = discriminant_at(*below_);
  const double error = search_.thresholds().rounding.entries * below_->tracks.front().pair.rounding;
  return !discriminant_.is_double_root(root, thresholds.trusted_share) &&
         confirms_root(discriminant, root - position_, thresholds.trusted_share) &&
         event.half_width <= widest && std::abs(root.imag()) >= resolution_ &&
         std::abs(root.imag()) * std::sqrt(std::abs(discriminant[2])) >= error;
}

FoundEvents VeeringWalk::run() {
  base_ = as_one_block();
  if (!base_) return {};
  const double range = search_.frame().range.length();
  const double speed = std::abs(search_.frame().speed(*base_));
  widest_ =
      off_axis_on_the_way * search_.thresholds().veering.widest * (1.0 + limit_rounding) * range / speed;
  resolution_ = resolution_share * range / speed;
  WalkRules rules;
  rules.resolution = resolution_;
  rules.rounding = loose * resolution_;
  rules.free_moves = free_rounds;
  rules.looks = most_rounds;
  const auto found = walk(expected_.position, rules, [this](Complex root) { return look(root); });
  if (found.end != WalkEnd::settled) return {};
  const Complex root = found.position + found.move;
  Event event = event_at(root);
  // A veering beyond the ends of the range is not even dismissed: by knows_veering it could hide another one
  // within the range that is close to it.
  if (!search_.log.is_on_range(event)) return {};
  if (!counts(event, root)) return {{}, {std::move(event)}};
  const Track& there = below_->tracks.front();
  std::vector<int> members(there.modes.size());
  std::iota(members.begin(), members.end(), 0);
  keep_shape(*below_, there, members, root.real() - position_, event);
  RunCounts& counts = search_.solver.counts();
  const auto stays = [](const Track&, const PathNode&, const Track&) {
    return std::numeric_limits<double>::quiet_NaN();  // the exceptional point is at a complex parameter
  };
  keep_sensitivities(search_.problem(), solved_point(search_.problem(), *below_, counts), *below_, there,
                     members, stays, event, counts);
  return {{std::move(event)}};
}

/// The modes of both eigenvalue branches of a predicted meeting.
std::vector<int> modes_of(const PathNode& node, const ExpectedMeeting& expected) {
  std::vector<int> modes;
  for (const EigenvalueBranch* branch : {&expected.a, &expected.b}) {
    for (const int i : branch->members)
      modes.push_back(node.tracks[branch->track].modes[static_cast<std::size_t>(i)]);
  }
  return sorted_modes(modes);
}

}  // namespace

FoundEvents find_veerings(const EventSearch& search, const Step& step) {
  const double speed = search.frame().speed(*step.left);
  FoundEvents found;
  EventLog log = search.log;
  log.found = &found;
  BelowExceptionalPoints known;
  const EventSearch own{search.solver, search.options, search.criteria, log, search.node};
  for (const ExpectedMeeting& expected :
       expected_beside(*step.left, step.right, step.h, search_width(search, *step.left))) {
    const std::vector<int> modes = modes_of(*step.left, expected);
    const Complex p(step.left->p + expected.position.real() * speed, expected.position.imag() * speed);
    if (modes.size() < 2 || log.knows_veering(p, modes)) continue;
    const double widest = search_width(search, *step.left);
    std::vector<Event> dismissed;
    if (!expected.is_rough) {
      FoundEvents located = VeeringWalk(own, step, expected, modes).run();
      std::erase_if(located.events, [&](Event& event) {
        return !settle_by_pencil(own, step, expected, modes, widest, event);
      });
      dismissed = std::exchange(located.dismissed, {});
      append(std::move(located), found);
    }
    VeeringsOfPencil of_pencil = find_from_pencil(own, step, expected, modes, widest, known);
    append(std::move(of_pencil.found), found);
    // What the series do not confirm may still be a veering, whose modes another step tells.
    const std::vector<Event> none;
    const EventLog untold{none, of_pencil.untold, log.range, log.thresholds};
    std::erase_if(dismissed, [&](const Event& event) {
      return untold.knows_veering(Complex(event.p, event.half_width), event.modes);
    });
    std::move(dismissed.begin(), dismissed.end(), std::back_inserter(found.dismissed));
  }
  return found;
}

}  // namespace eigentrail
