// Where two eigenvalues meet, or would meet beside the real parameter axis: roots of ((s_a - s_b) / 2)^2 in
// the complex plane of the path's coordinate. That function stays smooth where they meet.
//
//     simple root on the real axis      exceptional point: modes coalesce, s = tau +- sqrt(delta)
//     double root on the real axis      crossing: the vectors stay apart
//     root a + ib beside the axis       veering of half-width |b|
#pragma once

#include <cmath>
#include <optional>

#include "continuation/tracks/strands.hpp"
#include "eigentrail/continuation/event.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// A meeting seen from a point beside or on it.
struct Meeting {
  bool found = false;
  EventKind kind = EventKind::collision;  ///< collision, crossing or veering
  double offset = 0.0;                    ///< from the point, in the path's coordinate
  double half_width = 0.0;
  Complex puiseux;           ///< leading Puiseux coefficient in the path's coordinate
  std::vector<int> members;  ///< indices of the roots of the block that meet, ascending
};

/// The meeting of two strands of a block nearest to a point; others that are as close as the two are to each
/// other may meet with them. `reach` bounds how far to look.
Meeting nearest_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                        double reach, const MeetingThresholds& thresholds = {});

/// Offset of the farthest meeting on the real axis that a step of length h has passed on its way to the
/// point; zero when there is none.
double earlier_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b, double h);

/// ((s_a - s_b) / 2)^2 at a point; empty when the two cannot be told from the others there.
ComplexVector discriminant_of(const Track& track, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace eigentrail
