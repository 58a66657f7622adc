#include "continuation/events/meeting_events.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/events/event_record.hpp"
#include "continuation/events/exceptional_point.hpp"
#include "continuation/events/static_points.hpp"
#include "continuation/tracks/members.hpp"
#include "eigentrail/modes/block_parts.hpp"

namespace eigentrail {
namespace {

/// The eigenvalue of the event: the mean of those that meet, with Im s >= 0. Its real part is zero where it
/// is below `rounding`, the error of the mean. `is_pair`: a pair and its conjugate meet, and the mean is real
/// but for rounding.
Complex place_of(const Track& track, const Meeting& meeting, bool is_pair, double rounding) {
  Complex mean = 0.0;
  for (const int i : meeting.members) mean += track.roots[i];
  mean /= static_cast<double>(meeting.members.size());
  if (std::abs(mean.real()) <= rounding) mean.real(0.0);
  const Complex s = chart_value(mean, track.pair.chart);
  if (is_pair) return s.real();
  return s.imag() < 0.0 ? std::conj(s) : s;
}

/// A veering at its place by the pencil; false where that has none. Members of large blocks, and veerings
/// narrower than any prediction is accurate, are left as they were found.
bool settle_veering(const EventSearch& search, const PathNode& node, const Track& track, Meeting& meeting) {
  const EventThresholds& thresholds = search.log.thresholds.event;
  const double known = thresholds.known_veering * search.frame().coordinate_range();
  if (meeting.members.size() != 2 || meeting.half_width <= known) return true;
  const auto place =
      located_veering(node.pencil.of(track.pair.part), track.pair.chart, {meeting.offset, meeting.half_width},
                      {track.roots[meeting.members[0]], track.roots[meeting.members[1]]},
                      known + thresholds.known_veering_share * meeting.half_width);
  if (!place) return false;
  meeting.offset = place->offset;
  meeting.half_width = place->half_width;
  return true;
}

/// Where two eigenvalues meet on the imaginary axis: 1 if they leave it with growing p, so that one of them
/// grows; -1 if they come from there. 0 for other collisions.
int direction_off_axis(const Event& event, int cycle) {
  if (event.s.real() != 0.0 || cycle != 2) return 0;
  const double square = (event.puiseux * event.puiseux).real();
  return square > 0.0 ? 1 : square < 0.0 ? -1 : 0;
}

/// How far from a meeting of two its Puiseux coefficient tells how they part: where the square of half their
/// distance is not yet more of a parabola than of a line.
double reach_of_puiseux(const Track& track, const Meeting& meeting, double range) {
  const ComplexVector square =
      meeting.members.size() == 2
          ? discriminant_series(part_series(track.series.Lambda, roots_of(track, meeting.members)), 1)
          : ComplexVector();
  if (square.size() < 3 || square[2] == 0.0) return range;
  return std::min(range, std::norm(meeting.puiseux) / std::abs(square[2]));
}

/// Whether a collision tells which way its eigenvalues part: by the Puiseux coefficient they leave their
/// error within its reach. Those of rigid-body motions, which are known to a root of rounding, do not.
bool parts_visibly(const EventSearch& search, const Track& track, const Meeting& meeting) {
  const double reach = reach_of_puiseux(track, meeting, search.frame().coordinate_range());
  const double farthest =
      std::abs(meeting.puiseux) * std::pow(reach, 1.0 / static_cast<double>(meeting.cycle));
  const Vector errors = rounding_of_roots(track, search.thresholds().rounding);
  return std::all_of(meeting.members.begin(), meeting.members.end(),
                     [&](int i) { return farthest > errors[i]; });
}

/// The event of a meeting; empty where no modes take part or the meeting is not an event.
std::optional<Event> event_of(const EventSearch& search, const PathNode& node, const MeetingOnEnd& found) {
  const Track& track = node.tracks[found.track];
  Meeting meeting = found.meeting;
  std::vector<int> modes;
  for (const int i : meeting.members) modes.push_back(track.modes[static_cast<std::size_t>(i)]);
  modes = sorted_modes(modes);
  if (modes.empty()) return std::nullopt;
  // With one mode only, a complex pair meets or approaches its own conjugate. An approach is no event.
  const bool is_pair = modes.size() == 1 && track.pair.is_real;
  if (is_pair && meeting.kind == EventKind::veering) return std::nullopt;
  // Eigenvalues that are equal only because they are infinite, where the mass is singular, are no event.
  const double size = track.roots(meeting.members).cwiseAbs().maxCoeff();
  if (track.pair.chart == Chart::reciprocal && size * search.problem().s_max <= 1.0) return std::nullopt;
  if (meeting.kind == EventKind::veering && !settle_veering(search, node, track, meeting))
    return std::nullopt;
  const double speed = search.frame().speed(node);
  Event event;
  event.kind = meeting.kind;
  event.p = node.p + meeting.offset * speed;
  event.s = place_of(track, meeting, is_pair, search.thresholds().rounding.entries * track.pair.rounding);
  event.modes = modes;
  if (event.kind == EventKind::veering) event.half_width = std::abs(speed) * meeting.half_width;
  if (event.kind == EventKind::collision && parts_visibly(search, track, meeting)) {
    const double exponent = 1.0 / static_cast<double>(meeting.cycle);
    event.puiseux = meeting.puiseux / std::pow(Complex(speed), exponent);
    if (track.pair.chart == Chart::reciprocal) event.puiseux *= -event.s * event.s;
    event.direction = direction_off_axis(event, meeting.cycle);
  }
  event.retrackings = found.looks;
  event.node = search.node;
  keep_shape(node, track, meeting.members, meeting.offset, event);
  RunCounts& counts = search.solver.counts();
  const auto moves = [&](const Track& along_path, const PathNode&, const Track& along_q) {
    return shift_of_meeting(along_path, along_q, meeting.kind, meeting.members);
  };
  keep_sensitivities(search.problem(), solved_point(search.problem(), node, counts), node, track,
                     meeting.members, moves, event, counts);
  return event;
}

}  // namespace

FoundEvents meeting_events(const EventSearch& search, const PathNode& node,
                           const std::vector<MeetingOnEnd>& meetings) {
  FoundEvents all;
  for (const MeetingOnEnd& meeting : meetings) {
    std::optional<Event> event = event_of(search, node, meeting);
    if (event) append(as_static_event(search, node, std::move(*event)), all);
  }
  return all;
}

void mark_meetings(const std::vector<MeetingOnEnd>& meetings, PathNode& node) {
  for (const MeetingOnEnd& found : meetings) {
    Track& track = node.tracks[found.track];
    track.met = united(track.met, found.meeting.members);
    track.hidden_within = std::max(track.hidden_within, found.meeting.hidden_within);
  }
}

void mark_doubtful(const std::vector<MeetingOnEnd>& meetings, PathNode& node) {
  for (const MeetingOnEnd& found : meetings) {
    if (!found.meeting.is_certain) node.tracks[found.track].told_apart = false;
  }
}

void name_births(const std::vector<Birth>& births, FoundEvents& found) {
  for (const Birth& birth : births) {
    for (Event& event : found.events) {
      if (event.kind == EventKind::collision && contains(event.modes, birth.parent))
        event.modes = sorted_modes(united(event.modes, {birth.born}));
    }
  }
}

std::vector<bool> coinciding_tracks(const PathNode& node, const std::vector<MeetingOnEnd>& meetings) {
  std::vector<bool> coincide(node.tracks.size(), false);
  for (const MeetingOnEnd& meeting : meetings) {
    if (meeting.meeting.kind != EventKind::veering) coincide[meeting.track] = true;
  }
  return coincide;
}

}  // namespace eigentrail
