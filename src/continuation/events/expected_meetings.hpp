// Where on a step eigenvalues are expected to meet, as the series at both of its ends tell.
#pragma once

#include "continuation/events/meetings.hpp"

namespace eigentrail {

/// A meeting that is expected on a step, at `position` from the left end.
struct ExpectedMeeting {
  Strand a, b;
  Complex position;
  ComplexVector discriminant_at_left = {}, discriminant_at_right = {};  ///< series, where they were told
  double doubt = INFINITY;  ///< how far the position may be off; infinite: not known
};

/// Meetings on or close to the real axis of two eigenvalues that are followed in one block, in the order in
/// which the step passes them.
std::vector<ExpectedMeeting> expected_in_blocks(const PathNode& left, const PathNode& right, double length);

/// Meetings within `width` beside the step of any two eigenvalues, in no particular order.
std::vector<ExpectedMeeting> expected_beside(const PathNode& left, const PathNode& right, double length,
                                             double width);

}  // namespace eigentrail
