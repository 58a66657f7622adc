// The events of a trace so far, and the one rule by which two events are the same.
#pragma once

#include <string>
#include <vector>

#include "continuation/path/path_frame.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// What a search found.
struct FoundEvents {
  std::vector<Event> events = {};
  std::vector<Event> dismissed = {};    ///< looked at, and none: they need not be looked at again
  std::vector<std::string> notes = {};  ///< for the user, in words
};

/// Adds `more` to `all`.
void append(FoundEvents more, FoundEvents& all);

/// A view of what is recorded.
struct EventLog {
  const std::vector<Event>& events;
  const std::vector<Event>& dismissed;
  const PathRange& range;
  const Thresholds& thresholds;
  const FoundEvents* found = nullptr;  ///< on the step at hand, not yet recorded; may be null

  /// Whether `event` is recorded, seen from another step.
  bool has(const Event& event) const;

  /// Whether the modes that pass the imaginary axis at `zero` meet there: one point, recorded as a collision.
  /// `located`: its place was located as a zero; else it is one near a double root, where derivatives of one
  /// eigenvalue end. `s_ref` is the magnitude that counts as zero.
  bool has_collision_at(const Event& zero, bool located, double s_ref) const;

  /// Whether a veering of these modes that is expected at a complex place of the parameter is known, or was
  /// dismissed.
  bool knows_veering(Complex p, const std::vector<int>& modes) const;

  /// Whether an event lies on the traced range, up to rounding.
  bool is_on_range(const Event& event) const;

 private:
  template <class Condition>
  bool any_event(const Condition& holds) const;
};

/// Appends what is on the range and not yet recorded. `log` is a view of the same lists.
void record(const EventLog& log, FoundEvents found, std::vector<Event>& events, std::vector<Event>& dismissed,
            std::vector<std::string>& notes);

/// Whether two events are one: of one kind, not in opposite directions, of the same modes, with the same
/// eigenvalue, at places that are no farther apart than they are known, seen from the same step or
/// neighbouring ones. An exceptional point beside the axis belongs to two eigenvalues, whichever modes these
/// are taken for on either side of it: of a veering the modes do not count.
bool are_one(const Event& a, const Event& b, double range, const EventThresholds& thresholds);

}  // namespace eigentrail
