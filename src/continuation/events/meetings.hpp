// Meetings: places where two eigenvalues coincide, on the real parameter axis or at a complex parameter
// beside it. They are the roots of the discriminant ((s_a - s_b) / 2)^2 in the complex plane of the path's
// coordinate. That function stays smooth where the eigenvalues coincide.
//
//     simple root on the real axis      exceptional point (collision): the eigenvectors coalesce, too
//     double root on the real axis      crossing: the eigenvectors stay different
//     root a + ib beside the axis       veering of half-width |b|
#pragma once

#include <cmath>
#include <optional>

#include "continuation/tracks/strands.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// A meeting, located from the series at a point on or beside it.
struct Meeting {
  bool found = false;
  EventKind kind = EventKind::collision;  ///< collision, crossing or veering
  double offset = 0.0;                    ///< from the point, in the path's coordinate
  double half_width = 0.0;                ///< of a veering, in the path's coordinate
  Complex puiseux;           ///< of a collision: leading Puiseux coefficient in the path's coordinate
  std::vector<int> members;  ///< indices of the roots of the block that meet, ascending
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

/// The meeting of two strands of a block (indices of their roots) that is nearest to the point. Other
/// eigenvalues of the block that are as close as the two are to each other may take part in it. `reach`:
/// length scale of the search, such as the length of the step; roots farther away than twice this do not
/// count.
Meeting nearest_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                        double reach, const MeetingThresholds& thresholds = {});

/// The collision of all eigenvalues of a block of three or more in one exceptional point. `reach` as above.
Meeting meeting_of_all(const Track& track, double reach);

/// Offset of the farthest meeting on the real axis between the beginning of a step of signed length h and the
/// point, as far as the series at the point is accurate. Zero when there is none.
double earlier_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b, double h);

/// Series of ((s_a - s_b) / 2)^2 at a point. Empty when the two cannot be separated from the other
/// eigenvalues of the block there.
ComplexVector discriminant_of(const Track& track, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace eigentrail
