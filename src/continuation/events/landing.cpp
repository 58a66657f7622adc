#include "continuation/events/landing.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/events/walk.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Of the range: a place is located when a walk to it moves by less; a double has two digits more.
constexpr double settled = 1e-13;
/// p on the end of the range, relatively to the larger of both: rounding of a step's length.
constexpr double on_end = 1e-14;
/// Newton's method for p(h) = end may leave the step by half its length on the way.
constexpr double beyond_step = 1.5;
/// Of the step: on steps longer than this share of the range the start of a trace looks for meetings.
constexpr double reach_at_start = 0.05;

using RealSight = Sight<double>;

/// In the coordinate across a plane the end of the range lies where p says so.
bool land_on_end(StepSolver& solver, Step& step) {
  const PathFrame& frame = solver.points().frame();
  if (!frame.plane) return true;
  const PathRange& range = frame.range;
  for (const double end : {range.to, range.from}) {
    const double side = end == range.to ? range.to - range.from : range.from - range.to;
    if ((step.right.p - end) * side <= 0.0 || step.right.p == end) continue;
    const double p = step.left->p;
    const double guess = step.h * (end - p) / (step.right.p - p);
    const auto look = [&](double distance) -> RealSight {
      AttemptedStep attempted = solver.attempt(distance);
      if (!attempted.step) return {RealSight::Kind::failed};
      step = std::move(*attempted.step);
      const double miss = end - step.right.p;
      const bool there = std::abs(miss) <= on_end * std::max(range.length(), std::abs(end));
      return {there ? RealSight::Kind::settled : RealSight::Kind::seen, miss / frame.speed(step.right)};
    };
    WalkRules rules;
    rules.begin = 0.0;
    rules.end = beyond_step * step.h;
    if (walk(guess, rules, look).end != WalkEnd::settled) return false;
    step.right.p = end;
    return true;
  }
  return true;
}

/// A fold becomes a point of the trace: eigenvalues vary beside it like the root of the distance, so p has to
/// be told relatively to its value there.
bool land_on_fold(StepSolver& solver, Step& step) {
  const PathFrame& frame = solver.points().frame();
  if (!frame.plane) return true;
  const double before = heading(frame, *step.left, step.h);
  const double behind = heading(frame, step.right, -step.h);
  if (!(before * behind < 0.0)) return true;
  const auto look = [&](double distance) -> RealSight {
    AttemptedStep attempted = solver.attempt(distance);
    if (!attempted.step) return {RealSight::Kind::failed};
    step = std::move(*attempted.step);
    return {RealSight::Kind::seen, fold_distance(frame, step.right)};
  };
  WalkRules rules;
  rules.resolution = settled;
  rules.rounding = on_fold;
  rules.begin = 0.0;
  rules.end = step.h;
  return walk(step.h * before / (before - behind), rules, look).end == WalkEnd::settled;
}

/// The first meeting on a step: where it lies, and the step that ends on it.
class MeetingLanding {
 public:
  MeetingLanding(StepSolver& solver, const Step& step, bool on_any_terms)
      : solver_(solver),
        step_(step),
        on_any_terms_(on_any_terms),
        thresholds_(solver.points().problem().thresholds.meeting),
        at_point_(thresholds_.at_point * solver.points().frame().coordinate_range()) {}

  /// Cuts the step on the first meeting that it passes. False where it is seen and not reached.
  bool land();
  /// The shorter step; empty where the step ends as it is.
  std::optional<Step> take_cut() { return std::move(cut_); }
  std::vector<MeetingOnEnd> take_meetings() { return std::move(meetings_); }

 private:
  enum class Approach { reached, nothing, failed };
  enum class Cut { done, none, failed };

  Cut cut_at(const ExpectedMeeting& expected, double& distance, int& looks);
  Approach land_as_told(const ExpectedMeeting& expected);
  Approach follow(const ExpectedMeeting& expected, bool trusting, double& distance, int& looks);
  RealSight look_from(double distance, const ExpectedMeeting& expected, bool trusting, StrandSampler& strands,
                      double& earlier);
  std::optional<Meeting> meeting_at_end(const ExpectedMeeting& expected) const;
  bool attempt(double distance);
  void record(const ExpectedMeeting& expected, int looks);
  const Track& left_track(const ExpectedMeeting& expected) const {
    return step_.left->tracks[expected.a.track];
  }

  StepSolver& solver_;
  const Step& step_;  ///< as it came: distances are told by it
  bool on_any_terms_;
  const MeetingThresholds& thresholds_;
  double at_point_;  ///< in the coordinate along the path
  std::optional<Step> cut_;
  std::vector<MeetingOnEnd> meetings_;
};

/// Cuts the step at a distance, if the point there is found.
bool MeetingLanding::attempt(double distance) {
  cut_ = solver_.attempt(distance).step;
  return cut_.has_value();
}

/// The meeting as seen from the end of the step, cut or not, if it lies there.
std::optional<Meeting> MeetingLanding::meeting_at_end(const ExpectedMeeting& expected) const {
  const Track& track = (cut_ ? cut_->right : step_.right).tracks[expected.a.track];
  const Meeting meeting =
      nearest_meeting(track, expected.a.members, expected.b.members, step_.h, thresholds_);
  if (!meeting.found || std::abs(meeting.offset) > at_point_ ||
      meeting.half_width > thresholds_.narrow * std::abs(step_.h))
    return std::nullopt;
  return meeting;
}

/// Where the dense output tells the place well enough the point is there at once; `nothing` when it does not,
/// or when the meeting is not there.
MeetingLanding::Approach MeetingLanding::land_as_told(const ExpectedMeeting& expected) {
  constexpr double sure = 0.1;  // of what counts as on the point
  const double position = expected.position.real();
  if (expected.doubt > sure * at_point_ || left_track(expected).departure || position == step_.h ||
      std::abs(position) <= at_point_)
    return Approach::nothing;
  if (!attempt(position)) return Approach::failed;
  if (meeting_at_end(expected)) return Approach::reached;
  cut_.reset();
  return Approach::nothing;
}

/// The meeting as seen from a distance along the step. `earlier` is set to the offset of another one that the
/// step passes before it.
RealSight MeetingLanding::look_from(double distance, const ExpectedMeeting& expected, bool trusting,
                                    StrandSampler& strands, double& earlier) {
  constexpr double seen_well = 3e-3;  // of the step: from here the series tell the place to all digits
  const double h = step_.h;
  const std::size_t index = expected.a.track;
  Track there;
  if (distance == h) {
    there = step_.right.tracks[index];
  } else {
    std::optional<SolvedPoint> point = solver_.points().follow(one_track(*step_.left, index), distance);
    if (!point) return {RealSight::Kind::failed};
    there = std::move(point->node.tracks.front());
  }
  there.roots = in_order_of(strands(distance / h), there.roots);
  const Meeting meeting = nearest_meeting(there, expected.a.members, expected.b.members, h, thresholds_);
  if (!meeting.found) return {RealSight::Kind::absent};
  const double move = std::abs(meeting.offset);
  const bool is_wide =
      meeting.kind == EventKind::veering && meeting.half_width > thresholds_.narrow * std::abs(h);
  // Double roots look like wide veerings from afar.
  if (is_wide && move < 2.0 * meeting.half_width) return {RealSight::Kind::absent};
  const bool near = move <= std::max(seen_well * std::abs(h), at_point_);
  earlier = near ? earlier_meeting(there, expected.a.members, expected.b.members, h) : 0.0;
  const double share = (distance + meeting.offset) / h;
  const bool trusted =
      trusting && move <= seen_well * std::abs(h) && share > seen_well && share < 1.0 && earlier == 0.0;
  return {trusted ? RealSight::Kind::settled : RealSight::Kind::seen, meeting.offset};
}

/// Follows a meeting to where it lies, as seen from ever nearer points, beginning at `distance`. `trusting`:
/// to where a near point sees it.
MeetingLanding::Approach MeetingLanding::follow(const ExpectedMeeting& expected, bool trusting,
                                                double& distance, int& looks) {
  constexpr double at_left_end = 1e-3;  // of the step: what lies nearer was seen before
  constexpr double beyond = 1e-9;       // of the step
  constexpr double has_left = 0.3;      // of the step: a move outside by more was a bad guess
  const PathFrame& frame = solver_.points().frame();
  const double h = step_.h;
  const double resolution =
      frame.plane ? settled : settled * std::max(frame.range.length(), std::abs(step_.left->p));
  StrandSampler strands(*step_.left, step_.right, expected.a.track, h);
  for (const bool may_go_back : {true, false}) {
    double earlier = 0.0;
    bool own_end = false;
    const auto look = [&](double at) {
      const RealSight sight = look_from(at, expected, trusting, strands, earlier);
      own_end = sight.kind == RealSight::Kind::settled;
      return sight;
    };
    WalkRules rules;
    rules.resolution = resolution;
    rules.rounding = at_point_;
    rules.begin = 0.0;
    rules.end = h;
    rules.slack = beyond * std::abs(h);
    rules.looks = most_looks - looks;
    const Walk<double> found = walk(distance, rules, look);
    looks += found.looks;
    distance = found.position;
    if (found.end == WalkEnd::absent) return Approach::nothing;
    if (found.end == WalkEnd::outside)
      return std::abs(found.move) < has_left * std::abs(h) || looks > 2 ? Approach::nothing
                                                                        : Approach::failed;
    if (found.end != WalkEnd::settled) return Approach::failed;
    if (own_end && std::abs(found.move) > resolution) {
      distance += found.move;
      return Approach::reached;
    }
    // The walk may have settled on one behind the first.
    const bool goes_back = may_go_back && earlier != 0.0 && (distance + earlier) / h > at_left_end;
    // The meeting on which the last step ended is known.
    if (!goes_back) return std::abs(distance) > at_point_ ? Approach::reached : Approach::nothing;
    distance += earlier;
  }
  return Approach::failed;
}

void MeetingLanding::record(const ExpectedMeeting& expected, int looks) {
  if (const std::optional<Meeting> meeting = meeting_at_end(expected))
    meetings_.push_back({expected.a.track, *meeting, looks});
}

/// Cuts the step at one expected meeting.
MeetingLanding::Cut MeetingLanding::cut_at(const ExpectedMeeting& expected, double& distance, int& looks) {
  const Approach as_told = land_as_told(expected);
  if (as_told == Approach::failed && !on_any_terms_) return Cut::failed;
  if (as_told == Approach::reached) {
    distance = cut_->h;
    return Cut::done;
  }
  Approach approach = follow(expected, true, distance, looks);
  if (approach == Approach::nothing) return Cut::none;
  // A block's modes are told apart at one end of a step at least: between two meetings there is a point.
  const bool between = approach == Approach::reached && left_track(expected).departure.has_value();
  if (between) distance *= 0.5;
  bool landed = approach == Approach::reached && (distance == step_.h || attempt(distance));
  if (landed && !between && !meeting_at_end(expected)) {
    cut_.reset();
    approach = follow(expected, false, distance, looks);
    landed = approach == Approach::reached && (distance == step_.h || attempt(distance));
  }
  if (landed) return Cut::done;
  cut_.reset();
  return on_any_terms_ ? Cut::none : Cut::failed;
}

bool MeetingLanding::land() {
  constexpr double worth_a_look = 1e-3;  // of the step: others that may lie on the same point
  const std::vector<ExpectedMeeting> expected = expected_in_blocks(*step_.left, step_.right, step_.h);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double distance = expected[i].position.real();
    int looks = 0;
    const Cut cut = cut_at(expected[i], distance, looks);
    if (cut == Cut::failed) return false;
    if (cut == Cut::none) continue;
    record(expected[i], looks);
    for (std::size_t j = i + 1; j < expected.size(); ++j) {
      if (std::abs(expected[j].position.real() - distance) <= worth_a_look * std::abs(step_.h))
        record(expected[j], 1);
    }
    break;
  }
  return true;
}

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
