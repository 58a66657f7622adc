#include "continuation/events/landing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/events/common_collision.hpp"
#include "continuation/events/step_checks.hpp"
#include "continuation/events/walk.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// As a share of the range: a place is located when a move to it is shorter than this, a few hundred
/// times rounding.
constexpr double landing_accuracy = 1e-13;
/// p counts as the end of the range if the difference is at most this share of the larger of the end and the
/// length of the range: rounding of the length of a step.
constexpr double on_end = 1e-14;
/// In steps: iterates of Newton's method for p(h) = end may lie up to this far from the left end.
constexpr double beyond_step = 1.5;
/// As a share of the range: distance within which meetings near the start are considered, before the length
/// of the first step is known.
constexpr double reach_at_start = 0.05;
/// In steps: from points nearer than this to a meeting, the series locate it to all digits.
constexpr double seen_well = 3e-3;
/// In half-widths: from points nearer than this the series distinguish a wide veering from a double root on
/// the real axis, which from afar can look like one.
constexpr double near_veering = 2.0;
/// In steps: what the series show nearer to the left end than this was found on the step before.
constexpr double at_left_end = 1e-3;
/// In steps: a position this close to the right end counts as the end: rounding of the position.
constexpr double beyond = 1e-9;
/// An iterate outside the step means that the meeting is not on it, if the last move was shorter than this
/// (in steps) or there were more looks than `few_looks`. Otherwise the prediction was too inaccurate to tell.
constexpr double has_left = 0.3;
constexpr int few_looks = 2;
/// In steps: predicted meetings this close to the one that was located may lie on the same point.
constexpr double worth_a_look = 1e-3;

/// Shortens a step in the coordinate across a plane to the end of the range in p. False if that fails. In the
/// coordinate p, a step never passes the end.
bool land_on_end(StepSolver& solver, Step& step) {
  const PathFrame& frame = solver.points().frame();
  if (!frame.plane) return true;
  const PathRange& range = frame.range;
  for (const double end : {range.to, range.from}) {
    const double side = end == range.to ? range.to - range.from : range.from - range.to;
    if ((step.right.p - end) * side <= 0.0 || step.right.p == end) continue;
    const double p = step.left->p;
    const double guess = step.h * (end - p) / (step.right.p - p);
    const auto look = [&](double distance) -> Sight {
      AttemptedStep attempted = solver.attempt(distance);
      if (!attempted.step) return {Sight::Kind::failed};
      step = std::move(*attempted.step);
      const double miss = end - step.right.p;
      const bool there = std::abs(miss) <= on_end * std::max(range.length(), std::abs(end));
      return {there ? Sight::Kind::settled : Sight::Kind::seen, miss / frame.speed(step.right)};
    };
    const WalkRules rules{.begin = 0.0, .end = beyond_step * step.h};
    if (walk(guess, rules, look).end != WalkEnd::settled) return false;
    step.right.p = step.right.path.parameters(range.traced, 0) = end;
    return true;
  }
  return true;
}

/// Shortens a step to the fold that it passes. False if that fails. A fold must be a point of the trace:
/// beside it the eigenvalues vary like the square root of p - p_fold, so that p_fold must be known
/// accurately.
bool land_on_fold(StepSolver& solver, Step& step) {
  const PathFrame& frame = solver.points().frame();
  if (!frame.plane) return true;
  const double before = heading(frame, *step.left, step.h);
  const double behind = heading(frame, step.right, -step.h);
  if (!(before * behind < 0.0)) return true;
  const auto look = [&](double distance) -> Sight {
    AttemptedStep attempted = solver.attempt(distance);
    if (!attempted.step) return {Sight::Kind::failed};
    step = std::move(*attempted.step);
    return {Sight::Kind::seen, fold_distance(frame, step.right)};
  };
  const WalkRules rules{.resolution = landing_accuracy, .rounding = on_fold, .begin = 0.0, .end = step.h};
  return walk(step.h * before / (before - behind), rules, look).end == WalkEnd::settled;
}

/// Locates the first meeting on a step, and shortens the step to it.
class MeetingLanding {
 public:
  MeetingLanding(StepSolver& solver, const Step& step, bool on_any_terms)
      : solver_(solver),
        step_(step),
        on_any_terms_(on_any_terms),
        thresholds_(solver.points().problem().thresholds.meeting),
        at_point_(thresholds_.at_point * solver.points().frame().coordinate_range()) {}

  /// Shortens the step to the first meeting that it passes. False if one is predicted and cannot be located.
  bool land() {
    MeetingSearch search{false, true};
    while (true) {
      const MeetingsOnStep expected = expected_in_blocks(*step_.left, step_.right, step_.h, search);
      double place = step_.h;
      const bool has_landed = land_on_first(expected.meetings, place);
      if (search.common && denies_common_) {
        search.common = false;  // what it seemed to hide is looked for
      } else if (!has_landed || search.all || place / step_.h + worth_a_look <= expected.complete_to) {
        return has_landed;
      } else {
        search.all = true;
      }
      cut_.reset();
      meetings_.clear();
    }
  }

  /// The shorter step; empty where the step is not shortened.
  std::optional<Step> take_cut() { return std::move(cut_); }
  std::vector<MeetingOnEnd> take_meetings() { return std::move(meetings_); }

 private:
  /// reached: the meeting is located; nothing: there is none on the step; failed: it cannot be located.
  enum class Approach { reached, nothing, failed };
  enum class Cut { done, none, failed };

  /// Shortens the step to the first of the expected meetings that it passes. `place` is set to its distance;
  /// it stays the length of the step where there is none. False if one cannot be located.
  bool land_on_first(const std::vector<ExpectedMeeting>& expected, double& place) {
    std::optional<std::size_t> first;
    int first_looks = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      double distance = expected[i].position.real();
      // A prediction may be off: what was found first can lie behind others that are expected later.
      if (first && distance / place >= 1.0 - worth_a_look) break;
      std::optional<Step> kept = std::exchange(cut_, std::nullopt);
      int looks = 0;
      const Cut cut = cut_at(expected[i], distance, looks);
      if (expected[i].is_of_all && cut != Cut::done) denies_common_ = true;
      if (cut == Cut::failed) return false;
      if (cut == Cut::none || (first && distance / place >= 1.0)) {
        cut_ = std::move(kept);
        continue;
      }
      first = i;
      place = distance;
      first_looks = looks;
    }
    if (!first) return true;
    record(expected[*first], first_looks);
    for (std::size_t j = 0; j < expected.size(); ++j) {
      const bool is_there = std::abs(expected[j].position.real() - place) <= worth_a_look * std::abs(step_.h);
      if (j != *first && is_there) record(expected[j], 1);
    }
    return true;
  }

  /// Shortens the step to one predicted meeting. `distance` is set to its position, and `looks` counts the
  /// points computed.
  Cut cut_at(const ExpectedMeeting& expected, double& distance, int& looks) {
    const auto go_there = [&](bool trusting) {
      const Approach approach = follow(expected, trusting, distance, looks);
      if (std::abs(distance - step_.h) <= beyond * std::abs(step_.h)) distance = step_.h;
      return approach;
    };
    Approach approach = go_there(true);
    if (approach == Approach::nothing) return Cut::none;
    // At one end of every step, at least, the eigenvalues of a block must be distinct, so that they can be
    // identified. If the step begins at a meeting it ends half way to the next one.
    const bool between =
        approach == Approach::reached && step_.left->tracks[expected.a.track].departure.has_value();
    if (between) distance *= 0.5;
    bool landed = approach == Approach::reached && (distance == step_.h || attempt(distance));
    if (landed && !between && !meeting_at_end(expected)) {
      cut_.reset();
      approach = go_there(false);
      landed = approach == Approach::reached && (distance == step_.h || attempt(distance));
    }
    if (landed) return Cut::done;
    cut_.reset();
    return on_any_terms_ ? Cut::none : Cut::failed;
  }

  /// Locates a meeting by Newton's method from `distance`, which is set to the result. `trusting` as in
  /// look_from. If another meeting lies before the result, goes back to it once; not if that turns out to be
  /// the known one at the left end, which from far away is seen inaccurately.
  Approach follow(const ExpectedMeeting& expected, bool trusting, double& distance, int& looks) {
    const PathFrame& frame = solver_.points().frame();
    const double h = step_.h;
    const double resolution =
        frame.plane ? landing_accuracy
                    : landing_accuracy * std::max(frame.range.length(), std::abs(step_.left->p));
    EigenvalueSampler branches(*step_.left, step_.right, expected.a.track, h);
    std::optional<double> later;  // a meeting that was located before one in front of it was looked for
    const auto no_other = [&] {
      if (!later) return Approach::nothing;
      distance = *later;
      return Approach::reached;
    };
    for (const bool may_go_back : {true, false}) {
      double earlier = 0.0;
      bool own_end = false;
      WalkRules rules{.resolution = resolution,
                      .rounding = at_point_,
                      .begin = 0.0,
                      .end = h,
                      // What is zero on a branch point is double, and known as that.
                      .slack = frame.on_branch_point(step_.right) ? at_point_ : beyond * std::abs(h),
                      .looks = most_looks - looks};
      const auto look = [&](double at) {
        double rounding = 0.0;
        const Sight sight = look_from(at, expected, trusting, branches, earlier, rounding);
        rules.rounding = std::max(at_point_, rounding);
        own_end = sight.kind == Sight::Kind::settled;
        return sight;
      };
      const Walk found = walk(distance, rules, look);
      looks += found.looks;
      distance = found.position;
      if (found.end == WalkEnd::absent || (found.end == WalkEnd::outside && later)) return no_other();
      const double in_front = distance - found.move + earlier;
      if (found.end == WalkEnd::outside && may_go_back && earlier != 0.0 && in_front / h > at_left_end) {
        distance = in_front;  // the step passes another one in front of that beyond its end
        continue;
      }
      if (found.end == WalkEnd::outside)
        return std::abs(found.move) < has_left * std::abs(h) || looks > few_looks ? Approach::nothing
                                                                                  : Approach::failed;
      if (found.end != WalkEnd::settled) return Approach::failed;
      if (own_end && std::abs(found.move) > resolution) {
        distance += found.move;
        return Approach::reached;
      }
      // The walk may have converged to a later meeting than the first.
      const bool goes_back = may_go_back && earlier != 0.0 && (distance + earlier) / h > at_left_end;
      if (!goes_back) return is_left_end(expected, distance) ? no_other() : Approach::reached;
      later = distance;
      distance += earlier;
    }
    return Approach::failed;
  }

  /// Estimates the offset of the meeting from the point at a distance from the left end. `earlier` is set to
  /// the offset of another meeting that the step passes before it, or to zero, and `rounding` to the error of
  /// the estimate by rounding. `trusting`: ends the walk as soon as the series there give the place to all
  /// digits.
  Sight look_from(double distance, const ExpectedMeeting& expected, bool trusting,
                  EigenvalueSampler& branches, double& earlier, double& rounding) {
    const double h = step_.h;
    const std::size_t index = expected.a.track;
    Track there;
    if (distance == h) {
      there = step_.right.tracks[index];
    } else {
      std::optional<SolvedPoint> point = solver_.points().follow(one_track(*step_.left, index), distance);
      if (!point) return {Sight::Kind::failed};
      there = std::move(point->node.tracks.front());
    }
    if (!expected.is_of_all) there.roots = in_order_of(branches(distance / h), there.roots);
    const Meeting meeting = seen_from(there, expected);
    if (!meeting.found) return {Sight::Kind::absent};
    rounding = meeting.rounding;
    const double move = std::abs(meeting.offset);
    const bool is_wide =
        meeting.kind == EventKind::veering && meeting.half_width > thresholds_.narrow * std::abs(h);
    if (is_wide && move < near_veering * meeting.half_width) return {Sight::Kind::absent};
    const bool near = !expected.is_of_all && move <= std::max(seen_well * std::abs(h), at_point_);
    earlier = near ? earlier_meeting(there, expected.a.members, expected.b.members, h) : 0.0;
    const double share = (distance + meeting.offset) / h;
    const bool trusted =
        trusting && move <= seen_well * std::abs(h) && share > seen_well && share < 1.0 && earlier == 0.0;
    return {trusted ? Sight::Kind::settled : Sight::Kind::seen, meeting.offset};
  }

  Meeting seen_from(const Track& track, const ExpectedMeeting& expected) const {
    return expected.is_of_all
               ? meeting_of_all(track, step_.h)
               : nearest_meeting(track, expected.a.members, expected.b.members, step_.h, thresholds_);
  }

  /// The meeting at the end of the step, shortened or not, if there is one.
  std::optional<Meeting> meeting_at_end(const ExpectedMeeting& expected) const {
    const Track& track = (cut_ ? cut_->right : step_.right).tracks[expected.a.track];
    const Meeting meeting = seen_from(track, expected);
    if (!meeting.found || std::abs(meeting.offset) > std::max(at_point_, meeting.rounding) ||
        meeting.half_width > thresholds_.narrow * std::abs(step_.h))
      return std::nullopt;
    return meeting;
  }

  /// Whether a meeting at this distance is at the left end of the step, and known there. Steps towards a
  /// collision of two modes that were followed one by one are shorter than `at_point` themselves; nothing has
  /// met at their left end. On a branch point the eigenvalue zero is double, and known as that.
  bool is_left_end(const ExpectedMeeting& expected, double distance) const {
    const PathFrame& frame = solver_.points().frame();
    const bool is_known = expected.has_just_met || frame.on_branch_point(*step_.left);
    return std::abs(distance) <= (is_known ? at_point_ : landing_accuracy * frame.coordinate_range());
  }

  /// Computes the step that ends at a distance. False if the point there is not found.
  bool attempt(double distance) {
    cut_ = solver_.attempt(distance).step;
    return cut_.has_value();
  }

  /// Adds the meeting to the list if it is at the end of the step; once where several are predicted close to
  /// it. Of crossings and collisions of some members and of more, which each pair sees as its neighbours are,
  /// the one of more stays.
  void record(const ExpectedMeeting& expected, int looks) {
    const std::optional<Meeting> meeting = meeting_at_end(expected);
    if (!meeting) return;
    const auto covers = [&](const Meeting& more, const Meeting& some) {
      return more.kind == some.kind && std::includes(more.members.begin(), more.members.end(),
                                                     some.members.begin(), some.members.end());
    };
    const auto is_it = [&](const MeetingOnEnd& other) {
      return other.track == expected.a.track && covers(other.meeting, *meeting);
    };
    if (std::any_of(meetings_.begin(), meetings_.end(), is_it)) return;
    std::erase_if(meetings_, [&](const MeetingOnEnd& other) {
      return other.track == expected.a.track && covers(*meeting, other.meeting);
    });
    meetings_.push_back({expected.a.track, *meeting, looks});
  }

  StepSolver& solver_;
  const Step& step_;  ///< the whole step; distances are measured from its left end
  bool on_any_terms_;
  const MeetingThresholds& thresholds_;
  double at_point_;  ///< threshold of the same name, in the coordinate along the path
  std::optional<Step> cut_;
  std::vector<MeetingOnEnd> meetings_;
  bool denies_common_ = false;  ///< a meeting of all eigenvalues of a block was expected, and is none
};

}  // namespace

std::optional<LandedStep> land(StepSolver& solver, Step step, bool on_any_terms) {
  const EventWork work(solver.points().counts());
  if (!land_on_end(solver, step) || !land_on_fold(solver, step)) return std::nullopt;
  MeetingLanding landing(solver, step, on_any_terms);
  if (!landing.land()) return std::nullopt;
  LandedStep landed{{}, landing.take_meetings()};
  std::optional<Step> cut = landing.take_cut();
  landed.step = cut ? std::move(*cut) : std::move(step);
  for (const MeetingOnEnd& meeting : landed.meetings) landed.step.meeting.push_back(meeting.track);
  if (!on_any_terms && overlooks_collision(landed.step, solver.points().problem().thresholds.rounding))
    return std::nullopt;
  return landed;
}

std::vector<MeetingOnEnd> meetings_at(const PathProblem& problem, const PathFrame& frame,
                                      const PathNode& node) {
  std::vector<MeetingOnEnd> meetings;
  const MeetingThresholds& thresholds = problem.thresholds.meeting;
  for (std::size_t i = 0; i < node.tracks.size(); ++i) {
    const Track& track = node.tracks[i];
    for (int a = 0; a < static_cast<int>(track.size()); ++a) {
      for (int b = 0; b < a; ++b) {
        const Meeting meeting =
            nearest_meeting(track, {b}, {a}, reach_at_start * frame.range.length(), thresholds);
        if (meeting.found && std::abs(meeting.offset) <= thresholds.at_point * frame.range.length())
          meetings.push_back({i, meeting, 0});
      }
    }
  }
  return meetings;
}

}  // namespace eigentrail
