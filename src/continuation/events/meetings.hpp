// Meetings: places where two eigenvalues coincide, on the real parameter axis or at a complex parameter
// beside it. They are the roots of the discriminant ((s_a - s_b) / 2)^2 in the complex plane of the path's
// coordinate. That function stays smooth where the eigenvalues coincide.
//
//     simple root on the real axis      exceptional point (collision): the eigenvectors coalesce, too
//     double root on the real axis      crossing: the eigenvectors stay different
//     root a + ib beside the axis       veering of half-width |b|
#pragma once

#include <vector>

#include "continuation/events/meeting.hpp"
#include "continuation/tracks/eigenvalue_branches.hpp"
#include "eigentrail/continuation/thresholds.hpp"

namespace eigentrail {

/// The meeting of two eigenvalue branches of a block (indices of their roots) that is nearest to the point.
/// Other eigenvalues of the block that are as close as the two are to each other may take part in it.
/// `reach`: length scale of the search, such as the length of the step; roots farther away than twice this do
/// not count.
Meeting nearest_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b,
                        double reach, const MeetingThresholds& thresholds = {});

/// Offset of the farthest meeting on the real axis between the beginning of a step of signed length h and the
/// point, as far as the series at the point is accurate. Zero when there is none.
double earlier_meeting(const Track& track, const std::vector<int>& a, const std::vector<int>& b, double h);

/// Series of ((s_a - s_b) / 2)^2 at a point. Empty when the two cannot be separated from the other
/// eigenvalues of the block there.
ComplexVector discriminant_of(const Track& track, const std::vector<int>& a, const std::vector<int>& b);

}  // namespace eigentrail
