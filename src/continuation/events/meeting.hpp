// A place where eigenvalues of a block coincide (meetings.hpp).
#pragma once

#include <vector>

#include "eigentrail/continuation/event.hpp"

namespace eigentrail {

/// A meeting, located from the series at a point on or beside it.
struct Meeting {
  bool found = false;
  EventKind kind = EventKind::collision;  ///< collision, crossing or veering
  double offset = 0.0;                    ///< from the point, in the path's coordinate
  double half_width = 0.0;                ///< of a veering, in the path's coordinate
  Complex puiseux = {};           ///< of a collision: leading Puiseux coefficient in the path's coordinate
  std::vector<int> members = {};  ///< indices of the roots of the block that meet, ascending
  /// Of a collision: how many eigenvalues follow one from another around it; they vary like this root of the
  /// distance. Fewer than the members where several such groups meet at one place, as in equal parts.
  int cycle = 2;
  /// Error of the offset of a single root by rounding. Two collisions close to each other are known less well
  /// than others, because the discriminant has little slope there.
  double rounding = 0.0;
  /// Distance from the meeting within which rounding hides its members, where these are many.
  double hidden_within = 0.0;
  /// Whether rounding leaves no doubt that a crossing is none of a narrow veering, in which the modes would
  /// turn back instead of going straight on.
  bool is_certain = true;
};

}  // namespace eigentrail
