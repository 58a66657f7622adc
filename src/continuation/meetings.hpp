// Where the eigenvalues of a block meet, or would meet beside the real parameter axis: roots of the block's
// discriminant in the complex plane of the path's coordinate.
//
//     simple root on the real axis      exceptional point: modes coalesce, s = tau +- sqrt(delta)
//     double root on the real axis      crossing: the vectors stay apart
//     root a + ib beside the axis       veering of half-width b
#pragma once

#include <optional>

#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// A meeting that is expected on a step.
struct ExpectedMeeting {
  std::size_t track = 0;
  double distance = 0.0;  ///< from the left end, signed, in the path's coordinate
};

/// Meetings on the step from `left` to `right` (the same tracks at both) or just beside it, in the order in
/// which they are met, with the root at most `width` off the real axis.
std::vector<ExpectedMeeting> expected_meetings(const PathNode& left, const PathNode& right, double length,
                                               double width);

/// A meeting seen from a point beside or on it.
struct Meeting {
  bool found = false;
  EventKind kind = EventKind::collision;  ///< collision, crossing or veering
  double offset = 0.0;                    ///< from the point, in the path's coordinate
  double half_width = 0.0;
  Complex root;              ///< the discriminant's root that tells the half-width, relative to the point
  Complex puiseux;           ///< leading Puiseux coefficient in the path's coordinate
  std::vector<int> members;  ///< indices of the roots of the block that meet
};

/// The meeting nearest to a point; `reach` bounds how far to look.
Meeting nearest_meeting(const Track& track, double reach);

}  // namespace eigentrail
