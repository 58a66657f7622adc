// How the modes of a point are computed: one by one, or all at once.
//
// One LU per mode costs the number of modes times n^3; products in modal coordinates serve all modes for some
// n^3 but only where all are followed, since the missing ones would be missing in the basis. The choice is by
// counted multiplications, not by time: the same scene takes the same route on every machine.
#pragma once

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Sizes on which the choice depends.
struct ModeWork {
  Eigen::Index freedoms = 0;  ///< n of the reduced pencil
  Eigen::Index modes = 0;     ///< followed, a complex pair counting once
  bool all = false;           ///< every mode there is, none of them infinite
  int order = 3;
};

/// Multiplications of reals per point in all, those of matrix products counted by what they cost beside those
/// of back-substitutions. Infinite where the route does not serve.
double route_work(ModeRoute route, const Structure& structure, const ModeWork& work);

/// The route of least work.
ModeRoute cheapest_route(const Structure& structure, const ModeWork& work);

}  // namespace eigentrail
