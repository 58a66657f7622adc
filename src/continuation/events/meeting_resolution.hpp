// How accurately the roots of a discriminant (meetings.hpp) are known: what rounding leaves undecided.
#pragma once

#include <vector>

#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

/// Rounding error of a part of a block, and the scale by which it becomes an error of the coordinate.
struct PartRounding {
  double lambda = 0.0;  ///< absolute error of Lambda
  double slope = 0.0;   ///< norm of the derivative of the part of Lambda
};

/// The error of Lambda is the unit rounding times the condition of the block. `part`: series of a part of
/// Lambda.
PartRounding rounding_of(const Track& track, const std::vector<ComplexMatrix>& part);

/// N less the mean of its eigenvalues times the unit matrix.
ComplexMatrix centred(ComplexMatrix N);

/// The same of Lambda at h.
ComplexMatrix centred(const std::vector<ComplexMatrix>& Lambda, double h);

/// Errors of the roots of a discriminant, in the path's coordinate.
struct RootResolution {
  double lambda = 0.0;     ///< error of Lambda
  double distance = 0.0;   ///< norm of the centred part at the point
  double roots = 0.0;      ///< of a root; half the distance of two into which rounding splits a double one
  double noise = 0.0;      ///< of the imaginary part of a single root
  bool defective = false;  ///< whether the part is defective at a double root
  /// Whether two roots that are farther apart than twice `roots` are not a double one that rounding has
  /// split.
  bool bounded = false;

  /// How far rounding moves a single root at which the discriminant has a slope.
  double of_root_with(double slope) const;
};

/// The resolution of the roots of the discriminant of `members` (indices of roots of the track), whose part
/// of Lambda has the series `part`. `reach` as in nearest_meeting.
RootResolution resolution_of_roots(const Track& track, const std::vector<int>& members,
                                   const std::vector<ComplexMatrix>& part, const ComplexVector& discriminant,
                                   double reach);

}  // namespace eigentrail
