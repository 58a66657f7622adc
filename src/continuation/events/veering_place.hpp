// The place of a veering, from the pencil at complex values of the coordinate.
//
// The series of eigenvalues tell where two of them nearly meet, but not well: the gap of a narrow veering has
// little slope at its roots, and beside other exceptional points the series are inaccurate, or show a meeting
// where there is none. Newton's method for exceptional points (exceptional_point.hpp) tells.
#pragma once

#include <array>
#include <optional>

#include "continuation/events/exceptional_point.hpp"

namespace eigentrail {

/// A veering beside a point: its exceptional points are at offset +- i half_width, one for each of two
/// conjugate pairs of eigenvalues, or both for the same two.
struct VeeringPlace {
  double offset = 0.0;      ///< from the point, in the path's coordinate
  double half_width = 0.0;  ///< in the path's coordinate
};

/// The place to which Newton's method leads from `seen`: the mean of both exceptional points where the two
/// eigenvalues `mu` (at the point, in the chart) have both. Empty where neither is found within `allowed` of
/// what was seen. Cost: two to four times a few LUs of size n + 2.
std::optional<VeeringPlace> located_veering(const ReducedPencil& pencil, Chart chart, VeeringPlace seen,
                                            const std::array<Complex, 2>& mu, double allowed);

}  // namespace eigentrail
