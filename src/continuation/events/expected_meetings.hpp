// Prediction, from the series at both ends of a step, of the places where eigenvalues meet (meetings.hpp).
#pragma once

#include "continuation/events/meetings.hpp"

namespace eigentrail {

/// A predicted meeting of the eigenvalues a and b.
struct ExpectedMeeting {
  EigenvalueBranch a, b;
  Complex position;           ///< distance from the left end; complex beside the real axis
  bool has_just_met = false;  ///< the two take part in a meeting at the left end
  /// The series at either end are no more than a hint of it.
  bool is_rough = false;
  bool is_of_all = false;  ///< all eigenvalues of the block, those of `a`, meet in one point
};

/// Meetings on a step.
struct MeetingsOnStep {
  std::vector<ExpectedMeeting> meetings;  ///< by ascending distance from the left end
  double complete_to = INFINITY;          ///< share of the step beyond which some may be left out
};

/// Which meetings are looked for.
struct MeetingSearch {
  /// Of eigenvalues that meet others as well, also those that lie behind the first meeting. Where many meet
  /// in quick succession, the step ends at the first.
  bool all = true;
  /// Also of all eigenvalues of a block in one point. Two of them are then not looked for where these hide
  /// them.
  bool common = true;
};

/// Meetings, on or close to the real axis, of eigenvalues of one block. `length`: signed length of the step.
MeetingsOnStep expected_in_blocks(const PathNode& left, const PathNode& right, double length,
                                  const MeetingSearch& search = {});

/// Meetings of any two eigenvalues at positions up to about `width` off the real axis, in no particular
/// order. Within a block, those close to the axis are left out: expected_in_blocks has them.
std::vector<ExpectedMeeting> expected_beside(const PathNode& left, const PathNode& right, double length,
                                             double width);

}  // namespace eigentrail
