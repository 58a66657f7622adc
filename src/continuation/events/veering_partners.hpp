// Veerings that are found from the pencil at complex parameters: where series do not confirm a prediction,
// because other exceptional points are as close to the real axis, and further ones of the same two modes.
#pragma once

#include <array>
#include <vector>

#include "continuation/events/event_search.hpp"
#include "continuation/events/exceptional_point.hpp"
#include "continuation/events/expected_meetings.hpp"
#include "continuation/step/step.hpp"

namespace eigentrail {

struct VeeringsOfPencil {
  FoundEvents found;
  /// Those of which the dense output of the step does not tell the modes, under the predicted ones. Other
  /// steps may tell.
  std::vector<Event> untold;
};

/// The eigenvalues at the real axis below the exceptional points that were found on a step: other predictions
/// often lead to the same points, and following both eigenvalues down takes longer than finding a point.
struct BelowExceptionalPoints {
  struct Entry {
    Complex place;  ///< of the exceptional point, as a distance from the left end of the step
    Complex mu;     ///< the double eigenvalue
    std::array<EigenvalueBelow, 2> below;
  };
  std::vector<Entry> entries;
};

/// The veerings to which Newton's method for exceptional points leads from a prediction, up to `widest` off
/// the real axis (in the coordinate along the path). Those in the log are not found again. `known`: of this
/// step; what is found is added. Cost: the reduced equations at a point, and an LU per iteration.
VeeringsOfPencil find_from_pencil(const EventSearch& search, const Step& step,
                                  const ExpectedMeeting& expected, const std::vector<int>& modes,
                                  double widest, BelowExceptionalPoints& known);

/// Puts a veering that was located from series where Newton's method leads from it: its own place to the
/// digits that rounding leaves. False where it leads to another place: the series were not accurate enough.
bool settle_by_pencil(const EventSearch& search, const Step& step, const ExpectedMeeting& expected,
                      const std::vector<int>& modes, double widest, Event& veering);

}  // namespace eigentrail
