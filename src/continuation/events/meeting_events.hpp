// The events of eigenvalues that meet at a point of the trace.
#pragma once

#include "continuation/events/event_search.hpp"
#include "continuation/events/landing.hpp"
#include "continuation/tracks/mode_order.hpp"

namespace eigentrail {

/// The events of meetings on a point. Modes that begin there are not yet among theirs: call before the
/// modes behind the point are ordered, and name_births afterwards.
FoundEvents meeting_events(const EventSearch& search, const PathNode& node,
                           const std::vector<MeetingOnEnd>& meetings);

/// Notes on the tracks of a point which of their roots meet there.
void mark_meetings(const std::vector<MeetingOnEnd>& meetings, PathNode& node);

/// Adds the modes that begin at the point to the collisions that their parents take part in.
void name_births(const std::vector<Birth>& births, FoundEvents& found);

/// Per track of a point, whether eigenvalues coincide there: they meet, and do not merely veer.
std::vector<bool> coinciding_tracks(const PathNode& node, const std::vector<MeetingOnEnd>& meetings);

}  // namespace eigentrail
