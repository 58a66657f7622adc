// Exceptional points at complex parameters close to the real axis, found without following any eigenvalue.
//
// Starting values are the complex roots of the discriminant of all eigenvalues, as a Chebyshev polynomial on
// overlapping windows of the real axis. Each is corrected with spectra at complex parameters, on the smooth
// function ((s_a - s_b) / 2)^2, and only listed if that vanishes. So every one that is listed is there;
// that none is missing is likely and not certain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "completeness/reference_events.hpp"
#include "eigentrail/continuation/event.hpp"

namespace eigentrail::test {

struct ExceptionalPoint {
  Complex p;  ///< Im p > 0; the conjugate is one too
  Complex s;  ///< the double eigenvalue there
};

/// Those with a distance up to `reach` from the real axis, by the real part.
std::vector<ExceptionalPoint> exceptional_points(const Family& family, double from, double to, double reach);

/// The exceptional point that the correction finds from a start; `s` tells which eigenvalues are meant.
std::optional<ExceptionalPoint> corrected(const Family& family, Complex p, std::optional<Complex> s = {});

struct VeeringComparison {
  std::vector<std::string> missing, invented;
};
/// Veerings of a trace up to one percent of the range. Two exceptional points on either side of the axis that
/// are nearly mirror images may be one veering.
VeeringComparison compare_veerings(const Family& family, double from, double to,
                                   const std::vector<Event>& events);

}  // namespace eigentrail::test
