// Choice how the modes of a point are computed: one by one, or all at once.
//
// One by one, each mode needs an LU of about n^3 operations. All at once, matrix products in modal
// coordinates compute all modes with a few n^3 operations in total, but only if every mode is followed: the
// eigenvectors of all modes together form the basis. The choice compares counted multiplications and not
// times, so that a scene takes the same route on every machine.
#pragma once

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Sizes on which the choice depends.
struct ModeWork {
  Eigen::Index freedoms = 0;  ///< n of the reduced pencil
  Eigen::Index modes = 0;     ///< followed, a complex pair counting once
  bool all = false;           ///< whether every mode is followed and none is infinite
  int order = 3;
};

/// Multiplications of real numbers per point, for all modes. Those of matrix products and factorizations are
/// weighted by their time relative to those of back-substitutions. Infinite if the route cannot be used.
double route_work(ModeRoute route, const Structure& structure, const ModeWork& work);

/// The route with the least work.
ModeRoute cheapest_route(const Structure& structure, const ModeWork& work);

}  // namespace eigentrail
