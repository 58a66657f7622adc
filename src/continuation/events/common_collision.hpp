// The collision of all eigenvalues of a block of three or more in one exceptional point.
//
// The sums of the powers of the eigenvalues about their mean, tr N^j with N the centred Lambda, are smooth
// functions of the coordinate, and all of them vanish there. Where m eigenvalues vary like the m-th root of
// the distance d from the point, that of order m is the first that does not vanish like d^2. Where all of
// them vary like the square root, as those of a tridiagonal matrix do with a vanishing off-diagonal, it is
// the second, and rounding hides the eigenvalues one by one long before it hides that sum: they are known to
// the m-th root of rounding, the sum to rounding itself.
#pragma once

#include <optional>
#include <vector>

#include "continuation/events/meeting.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/continuation/path_node.hpp"

namespace eigentrail {

/// The collision of all eigenvalues of a part of Lambda, given by its series about a point, with an error
/// `lambda` by rounding. Empty if there is none within `reach`, in the path's coordinate, that the series
/// show.
std::optional<Meeting> common_collision(const std::vector<ComplexMatrix>& part, double lambda, double reach);

/// The same of all eigenvalues of a block, from its series at a point. `found` is false where there is none.
Meeting meeting_of_all(const Track& track, double reach);

/// A place on a step, in shares of it, with the distance within which rounding hides the eigenvalues.
struct PlaceOnStep {
  double t = 0.0;
  double hidden_within = 0.0;
};

/// Where all eigenvalues of a block of three or more collide on a step, ascending, from its functions on the
/// step. Empty for smaller blocks.
std::vector<PlaceOnStep> common_collisions_on_step(const HermiteInterpolant& functions, double lambda);

}  // namespace eigentrail
