#include "continuation/events/event_log.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "continuation/tracks/members.hpp"

namespace eigentrail {
namespace {

/// Share of the range by which an event may lie outside it: the accuracy to which its place is located.
constexpr double off_range = 1e-12;
/// Largest difference of the node numbers of one event that is found from neighbouring steps. On a path that
/// turns back, an event with the same p and modes can occur again later; that is another event.
constexpr int neighbouring = 2;
/// Safety factor on the rounding of coinciding eigenvalues.
constexpr double event_rounding_margin = 10.0;

/// Largest distance in s between a collision of m eigenvalues and one of them at a place that differs by
/// `place` in p: the Puiseux coefficient times the m-th root of `place`, plus the m-th root of rounding, to
/// which the eigenvalues are known.
double spread_at(const Event& collision, double place, double s_ref) {
  // A collision of a pair on the real axis may be recorded with one mode, before the second one begins.
  const double m = std::max<double>(2.0, static_cast<double>(collision.modes.size()));
  const double scale = std::max(std::abs(collision.s), s_ref);
  return std::abs(collision.puiseux) * std::pow(place, 1.0 / m) +
         event_rounding_margin * scale * std::pow(std::numeric_limits<double>::epsilon(), 1.0 / m);
}

template <class Condition>
bool any_event(const EventLog& log, const Condition& holds) {
  const auto any_of = [&](const std::vector<Event>& list) {
    return std::any_of(list.begin(), list.end(), holds);
  };
  return any_of(log.events) || (log.found != nullptr && any_of(log.found->events));
}

}  // namespace

void append(FoundEvents more, FoundEvents& all) {
  std::move(more.events.begin(), more.events.end(), std::back_inserter(all.events));
  std::move(more.notes.begin(), more.notes.end(), std::back_inserter(all.notes));
}

bool are_one(const Event& a, const Event& b, double range, const EventThresholds& thresholds,
             bool may_turn_back) {
  if (a.kind != b.kind || (may_turn_back && std::abs(a.node - b.node) > neighbouring)) return false;
  // Zeros in opposite directions are different events, however close they are; so are a minimum and a
  // maximum.
  if (a.direction * b.direction < 0) return false;
  const bool veering = a.kind == EventKind::veering;
  // A branch point is one of the equilibrium, whichever modes show it.
  const bool of_same_modes = veering || a.kind == EventKind::branch_point || a.modes == b.modes;
  const double place = (veering ? thresholds.same_veering : thresholds.same_place) * range;
  const double scale = std::max(std::abs(a.s), std::abs(b.s));
  return of_same_modes && std::abs(a.p - b.p) <= place && std::abs(a.half_width - b.half_width) <= place &&
         (!veering || std::abs(a.s - b.s) <= thresholds.same_eigenvalue * scale);
}

bool EventLog::has(const Event& event) const {
  return any_event(*this, [&](const Event& other) {
    return are_one(other, event, range.length(), thresholds.event, may_turn_back);
  });
}

bool EventLog::has_collision_at(const Event& zero, bool located, double s_ref) const {
  return any_event(*this, [&](const Event& other) {
    if (other.kind != EventKind::collision) return false;
    // In a collision of one mode a pair touches the real axis and stays a pair. Its crossing of the imaginary
    // axis is another event.
    if (zero.kind == EventKind::flutter && other.modes.size() < 2) return false;
    const bool takes_part = std::any_of(zero.modes.begin(), zero.modes.end(),
                                        [&](int mode) { return contains(other.modes, mode); });
    // Beside a collision on the imaginary axis, rounding can cause zeros of Re s within the accuracy of a
    // double eigenvalue. If the collision is off the axis, a zero that has been located is a different event
    // unless its place is the same to the accuracy of a zero.
    const bool meets_on_axis = other.s.real() == 0.0;
    // The real eigenvalues of a pair that meets off the axis are not zero there, and of two that do not part
    // from each other like a root one goes on through zero.
    if (zero.kind == EventKind::divergence && located && (!meets_on_axis || other.puiseux == 0.0))
      return false;
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
  return any_event(*this, is_it);
}

bool EventLog::is_on_range(const Event& event) const {
  const double slack = off_range * range.length();
  return event.p >= std::min(range.from, range.to) - slack &&
         event.p <= std::max(range.from, range.to) + slack;
}

void record(const EventLog& log, std::vector<Event> found, std::vector<Event>& events) {
  const auto [low, high] = std::minmax(log.range.from, log.range.to);
  for (Event& event : found) {
    if (!log.is_on_range(event) || log.has(event)) continue;
    event.p = std::clamp(event.p, low, high);  // by rounding it may lie outside
    events.push_back(std::move(event));
  }
}

}  // namespace eigentrail
