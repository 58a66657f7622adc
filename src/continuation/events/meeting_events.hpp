// Events of meetings (meetings.hpp) at a point of the trace: collisions, crossings and narrow veerings.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/events/landing.hpp"
#include "continuation/tracks/mode_order.hpp"

namespace eigentrail {

/// The events of the meetings at a point. Must be called before the modes behind the point are ordered
/// (mode_order.hpp). Modes that begin there are not in the lists of the events; name_births adds them
/// afterwards.
FoundEvents meeting_events(const EventSearch& search, const PathNode& node,
                           const std::vector<MeetingOnEnd>& meetings);

/// Adds to Track::met of the tracks of a point which of their roots take part in the meetings.
void mark_meetings(const std::vector<MeetingOnEnd>& meetings, PathNode& node);

/// Clears Track::told_apart of the tracks that have a meeting whose kind is not certain: which mode is which
/// behind it depends on the kind.
void mark_doubtful(const std::vector<MeetingOnEnd>& meetings, PathNode& node);

/// Adds the modes that begin at the point to the collisions in which their parents take part.
void name_births(const std::vector<Birth>& births, FoundEvents& found);

/// Per track of a point, whether eigenvalues coincide there: there is a meeting other than a veering.
std::vector<bool> coinciding_tracks(const PathNode& node, const std::vector<MeetingOnEnd>& meetings);

}  // namespace eigentrail
