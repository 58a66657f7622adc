// The events of a trace so far, and the rules by which two events are the same.
#pragma once

#include <string>
#include <vector>

#include "continuation/path/path_frame.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// The result of a search for events.
struct FoundEvents {
  std::vector<Event> events = {};
  std::vector<std::string> notes = {};  ///< remarks for the user
};

/// Adds `more` to `all`.
void append(FoundEvents more, FoundEvents& all);

/// A view of the recorded events. Refers to the lists.
struct EventLog {
  const std::vector<Event>& events;
  const PathRange& range;
  const Thresholds& thresholds;
  const FoundEvents* found = nullptr;  ///< on the present step, not yet recorded; may be null
  bool may_turn_back = true;           ///< whether the path may pass a value of the parameter again

  /// Whether the same event is recorded already, for example from the step before.
  bool has(const Event& event) const;

  /// Whether `zero`, a zero of Re s, is a recorded collision in which its mode takes part. `located`:
  /// Newton's method converged to the zero; else it is one at a double eigenvalue, whose place is less
  /// accurate. `s_ref`: magnitude below which an eigenvalue counts as zero, 1/s.
  bool has_collision_at(const Event& zero, bool located, double s_ref) const;

  /// Whether a veering of these modes, predicted at the complex parameter value p, is recorded already.
  bool knows_veering(Complex p, const std::vector<int>& modes) const;

  /// Whether an event lies within the traced range, up to rounding.
  bool is_on_range(const Event& event) const;
};

/// Appends to `events` what is within the range and not recorded yet. `log` is a view of the same events.
void record(const EventLog& log, std::vector<Event> found, std::vector<Event>& events);

/// Whether two events are the same: of one kind, found on the same or on neighbouring steps if the path may
/// turn back, not in opposite directions, of the same modes, and in place and half-width no farther apart
/// than the accuracy to which these are known. Of veerings the eigenvalues are compared instead of the modes:
/// the two eigenvalues at an exceptional point can be labelled with different modes on either side. `range`:
/// length of the range.
bool are_one(const Event& a, const Event& b, double range, const EventThresholds& thresholds,
             bool may_turn_back = true);

}  // namespace eigentrail
