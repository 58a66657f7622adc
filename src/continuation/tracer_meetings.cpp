// Meetings of eigenvalues that are followed in one block: the step ends on them, so that what the modes do
// there is known exactly on both sides.
#include <algorithm>
#include <cmath>

#include "continuation/event_tools.hpp"
#include "continuation/tracer.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Exceptional points this share of the step off the axis get a point of their own: they are so near that the
/// dense output does not tell on which side they lie.
constexpr double narrow = 3e-3;
/// Of the range: meetings this close to a point lie on it.
constexpr double at_point = 1e-10;

}  // namespace

/// The trace may begin on a special point.
void Tracer::record_meetings_at_start() {
  const double glimpse = direction_ * 1e-6 * range();
  for (std::size_t i = 0; i < node_.tracks.size(); ++i) {
    Track& track = node_.tracks[i];
    bool coincide = false;
    for (int a = 0; a < static_cast<int>(track.size()); ++a) {
      for (int b = 0; b < a; ++b) {
        const Meeting meeting = nearest_meeting(track, {b}, {a}, 0.05 * range());
        if (!meeting.found || std::abs(meeting.offset) > at_point * range()) continue;
        record_meeting(node_, i, meeting, 0);
        track.met = united(track.met, meeting.members);
        coincide = coincide || meeting.kind != EventKind::veering;
      }
    }
    if (!coincide) continue;
    track.departure = Track::Departure{glimpse, block_roots(evaluate_series(track.functions, glimpse))};
    if (track.pair.is_real) settle_real_block(track);
    track.arriving = track.modes;
  }
}

/// Follows a meeting to where it lies, by its offset as seen from ever nearer points of a step to `next`,
/// beginning at `distance`; `trusting` to where a near point sees it.
Tracer::Approach Tracer::approach_meeting(const ExpectedMeeting& expected, double h, const PathNode& next,
                                          StrandSampler& strands, bool trusting, double& distance,
                                          int& retrackings) {
  const double resolution = plane_ ? settled : settled * std::max(range(), std::abs(node_.p));
  const std::size_t index = expected.a.track;
  const PathNode base = with_tracks(node_, {index});
  double last_move = INFINITY;
  bool went_back = false;
  for (; retrackings < most_retrackings; ++retrackings) {
    std::optional<PathNode> point = distance == h ? with_tracks(next, {index}) : probe(base, distance);
    if (!point) return Approach::failed;
    Track& there = point->tracks.front();
    there.roots = in_order_of(strands(distance / h), there.roots);
    const Meeting meeting = nearest_meeting(there, expected.a.members, expected.b.members, h);
    if (!meeting.found) return Approach::nothing;
    const double move = std::abs(meeting.offset);
    const bool is_wide = meeting.kind == EventKind::veering && meeting.half_width > narrow * std::abs(h);
    // Double roots look like wide veerings from afar.
    if (is_wide && move < 2.0 * meeting.half_width) return Approach::nothing;
    // Settled, or no longer getting nearer at the level of rounding.
    if (move <= resolution || (move > 0.5 * last_move && move <= at_point * coordinate_range())) {
      // The iteration may have settled on one behind the first.
      const double earlier = earlier_meeting(there, expected.a.members, expected.b.members, h);
      if (earlier != 0.0 && (distance + earlier) / h > 1e-3 && !went_back) {
        went_back = true;
        last_move = INFINITY;
        distance += earlier;
        continue;
      }
      // The meeting on which the last step ended is known.
      return std::abs(distance) > at_point * coordinate_range() ? Approach::reached : Approach::nothing;
    }
    last_move = move;
    distance += meeting.offset;
    const double share = distance / h;
    constexpr double seen_well = 3e-3;  // of the step: the series of the gap tells it to all digits
    if (trusting && move <= seen_well * std::abs(h) && share > seen_well && share < 1.0 &&
        earlier_meeting(there, expected.a.members, expected.b.members, h) == 0.0)
      return Approach::reached;
    if (!(share > 0.0 && share <= 1.0 + 1e-9)) {
      return move < 0.3 * std::abs(h) || retrackings > 1 ? Approach::nothing : Approach::failed;
    }
    if (share > 1.0) distance = h;
  }
  return Approach::failed;
}

/// The meeting as seen from a point, if it lies there.
std::optional<Meeting> Tracer::meeting_at(double h, const ExpectedMeeting& expected,
                                          const PathNode& node) const {
  const Track& track = node.tracks[expected.a.track];
  const Meeting meeting = nearest_meeting(track, expected.a.members, expected.b.members, h);
  if (!meeting.found || std::abs(meeting.offset) > at_point * coordinate_range() ||
      meeting.half_width > narrow * std::abs(h))
    return std::nullopt;
  return meeting;
}

/// Where the dense output tells the place well enough, the point is there at once: `nothing` when it does
/// not, or when the meeting is not there.
Tracer::Approach Tracer::land_as_told(double h, const ExpectedMeeting& expected,
                                      std::optional<PathNode>& next) {
  constexpr double sure = 0.1;
  const double position = expected.position.real();
  if (expected.doubt > sure * at_point * coordinate_range() || node_.tracks[expected.a.track].departure ||
      position == h || std::abs(position) <= at_point * coordinate_range())
    return Approach::nothing;
  std::optional<PathNode> point;
  if (attempt(position, point)) return Approach::failed;
  if (!meeting_at(h, expected, *point)) return Approach::nothing;
  next = std::move(point);
  return Approach::reached;
}

/// Shortens the step so that it ends on the first meeting inside it.
bool Tracer::land_on_meeting(double& h, std::optional<PathNode>& next) {
  const StageTimer timer(result_.counts.events_seconds);
  const EventWork work(result_.counts);
  const std::vector<ExpectedMeeting> expected = expected_in_blocks(node_, *next, h);
  std::vector<bool> coincide(next->tracks.size(), false);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    double distance = expected[i].position.real();
    int retrackings = 0;
    const Approach as_told = land_as_told(h, expected[i], next);
    if (as_told == Approach::failed && std::abs(h) > uncertified_below_) return false;
    if (as_told != Approach::reached) {
      StrandSampler strands(node_, *next, expected[i].a.track, h);
      Approach approach = approach_meeting(expected[i], h, *next, strands, true, distance, retrackings);
      if (approach == Approach::nothing) continue;
      // A block's modes are told apart at one end of a step at least: between two meetings there is a point.
      const bool between = approach == Approach::reached && node_.tracks[expected[i].a.track].departure;
      if (between) distance *= 0.5;
      bool landed = approach == Approach::reached && (distance == h || !attempt(distance, next));
      if (landed && !between && !meeting_at(h, expected[i], *next)) {
        approach = approach_meeting(expected[i], h, *next, strands, false, distance, retrackings);
        landed = approach == Approach::reached && !attempt(distance, next);
      }
      if (!landed && std::abs(h) > uncertified_below_) return false;
      if (!landed) continue;
      if (between) {
        h = distance;
        break;
      }
    }
    record_at(h, expected[i], retrackings, *next, coincide);
    constexpr double worth_a_look = 1e-3;
    for (std::size_t j = i + 1; j < expected.size(); ++j) {
      if (std::abs(expected[j].position.real() - distance) <= worth_a_look * std::abs(h))
        record_at(h, expected[j], 1, *next, coincide);
    }
    h = distance;
    break;
  }
  label_departure(h, *next, coincide);
  return true;
}

/// Records a meeting if it lies on the point where a step of length h is cut.
void Tracer::record_at(double h, const ExpectedMeeting& expected, int retrackings, PathNode& next,
                       std::vector<bool>& coincide) {
  const std::optional<Meeting> meeting = meeting_at(h, expected, next);
  if (!meeting) return;
  Track& track = next.tracks[expected.a.track];
  record_meeting(next, expected.a.track, *meeting, retrackings);
  track.met = united(track.met, meeting->members);
  if (meeting->kind != EventKind::veering) coincide[expected.a.track] = true;
}

void Tracer::record_meeting(const PathNode& node, std::size_t index, const Meeting& meeting,
                            int retrackings) {
  const Track& track = node.tracks[index];
  std::vector<int> modes;
  for (const int i : meeting.members) {
    const int mode = track.modes[static_cast<std::size_t>(i)];
    if (mode >= 0) modes.push_back(mode);
  }
  modes = sorted_modes(modes);
  if (modes.empty()) return;
  // One mode alone: a pair and its conjugate. They touch the real axis, or merely come near it.
  const bool pair = modes.size() == 1 && track.pair.is_real;
  if (pair && meeting.kind == EventKind::veering) return;
  // Eigenvalues that meet at infinity, where the mass is singular, are no coincidence of modes.
  if (track.pair.chart == Chart::reciprocal && std::abs(track.roots.mean()) * problem_.s_max <= 1.0) return;
  Event event;
  event.kind = meeting.kind;
  const double speed = coefficient(node.path.parameters, problem_.traced, 1);
  event.p = node.p + meeting.offset * speed;
  Complex mean = 0.0;
  for (const int i : meeting.members) mean += track.roots[i];
  event.s = chart_value(mean / static_cast<double>(meeting.members.size()), track.pair.chart);
  if (event.s.imag() < 0.0) event.s = std::conj(event.s);
  if (track.pair.is_real && pair) event.s = event.s.real();
  event.modes = modes;
  if (event.kind == EventKind::veering) event.half_width = std::abs(speed) * meeting.half_width;
  if (event.kind == EventKind::collision) {
    const double exponent = 1.0 / static_cast<double>(meeting.members.size());
    event.puiseux = meeting.puiseux / std::pow(Complex(speed), exponent);
    if (track.pair.chart == Chart::reciprocal) event.puiseux *= -event.s * event.s;
  }
  event.retrackings = retrackings;
  event.node = result_.nodes;
  keep_shape(node, index, meeting.members, meeting.offset, event);
  const auto moves = [&](const Track& along_path, const PathNode&, const Track& along_q) {
    return shift_of_meeting(along_path, along_q, meeting.kind, meeting.members);
  };
  keep_sensitivities(solved_point(node), node, index, meeting.members, moves, event);
  add_static_event(node, std::move(event));
}

}  // namespace eigentrail
