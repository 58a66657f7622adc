#include "continuation/events/event_log.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace eigentrail {
namespace {

/// Share of the range by which an event may lie outside it: rounding of its place.
constexpr double off_range = 1e-12;
/// Nodes: an event may be seen from two neighbouring steps. On a path that turns back it is another one
/// farther on, even where all numbers are the same.
constexpr int neighbouring = 2;

template <class Condition>
bool any_of(const std::vector<Event>& events, const Condition& holds) {
  return std::any_of(events.begin(), events.end(), holds);
}

/// How far eigenvalues that meet at a collision may seem from it, at places known to `place`: they move like
/// the m-th root of the distance in p, and are known to the m-th root of rounding.
double spread_at(const Event& collision, double place, double s_ref) {
  // A pair that meets on the real axis may be recorded before its second mode begins.
  const double m = std::max<double>(2.0, static_cast<double>(collision.modes.size()));
  const double scale = std::max(std::abs(collision.s), s_ref);
  return std::abs(collision.puiseux) * std::pow(place, 1.0 / m) +
         10.0 * scale * std::pow(std::numeric_limits<double>::epsilon(), 1.0 / m);
}

}  // namespace

void append(FoundEvents more, FoundEvents& all) {
  std::move(more.events.begin(), more.events.end(), std::back_inserter(all.events));
  std::move(more.dismissed.begin(), more.dismissed.end(), std::back_inserter(all.dismissed));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(all.notes));
}

bool are_one(const Event& a, const Event& b, double range, const EventThresholds& thresholds) {
  if (a.kind != b.kind || std::abs(a.node - b.node) > neighbouring) return false;
  // Between two zeros in one direction there is one in the other.
  if (a.direction * b.direction < 0) return false;
  const bool veering = a.kind == EventKind::veering;
  const double place = (veering ? thresholds.same_veering : thresholds.same_place) * range;
  const double scale = std::max(std::abs(a.s), std::abs(b.s));
  return (veering || a.modes == b.modes) && std::abs(a.p - b.p) <= place &&
         std::abs(a.half_width - b.half_width) <= place &&
         (!veering || std::abs(a.s - b.s) <= thresholds.same_eigenvalue * scale);
}

template <class Condition>
bool EventLog::any_event(const Condition& holds) const {
  return any_of(events, holds) || (found != nullptr && any_of(found->events, holds));
}

bool EventLog::has(const Event& event) const {
  return any_event(
      [&](const Event& other) { return are_one(other, event, range.length(), thresholds.event); });
}

bool EventLog::has_collision_at(const Event& zero, bool located, double s_ref) const {
  return any_event([&](const Event& other) {
    if (other.kind != EventKind::collision) return false;
    // A pair that meets its own conjugate and stays a pair does not leave the axis by that.
    if (zero.kind == EventKind::flutter && other.modes.size() < 2) return false;
    const bool takes_part = std::any_of(zero.modes.begin(), zero.modes.end(), [&](int mode) {
      return std::find(other.modes.begin(), other.modes.end(), mode) != other.modes.end();
    });
    // Modes that meet on the axis itself leave it there, and on their way rounding makes zeros beside it.
    // Modes that meet off the axis pass it elsewhere, however near that is.
    const double on_axis = thresholds.criterion.on_axis * std::max(std::abs(other.s), s_ref);
    const bool meets_on_axis = std::abs(other.s.real()) <= on_axis;
    const EventThresholds& same = thresholds.event;
    const double place =
        (located && !meets_on_axis ? same.same_place : same.same_double_root) * range.length();
    return takes_part && std::abs(other.p - zero.p) <= place &&
           std::abs(other.s - zero.s) <= spread_at(other, place, s_ref);
  });
}

bool EventLog::knows_veering(Complex p, const std::vector<int>& modes) const {
  const auto is_it = [&](const Event& event) {
    const double slack = thresholds.event.known_veering_share * event.half_width +
                         thresholds.event.known_veering * range.length();
    return event.modes == modes && std::abs(event.p - p.real()) <= slack &&
           std::abs(event.half_width - std::abs(p.imag())) <= slack;
  };
  return any_event(is_it) || any_of(dismissed, is_it) ||
         (found != nullptr && any_of(found->dismissed, is_it));
}

bool EventLog::is_on_range(const Event& event) const {
  const double slack = off_range * range.length();
  return event.p >= std::min(range.from, range.to) - slack &&
         event.p <= std::max(range.from, range.to) + slack;
}

void record(const EventLog& log, FoundEvents found, std::vector<Event>& events, std::vector<Event>& dismissed,
            std::vector<std::string>& notes) {
  for (Event& event : found.events) {
    if (log.is_on_range(event) && !log.has(event)) events.push_back(std::move(event));
  }
  for (Event& event : found.dismissed) dismissed.push_back(std::move(event));
  for (std::string& note : found.notes) notes.push_back(std::move(note));
}

}  // namespace eigentrail
