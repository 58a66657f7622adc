// Choice how the modes of a point are computed: one by one, or all at once.
//
// One by one, each mode needs an LU of about n^3 operations. All at once, matrix products in modal
// coordinates compute all modes with a few n^3 operations in total, but only if every mode is followed: the
// eigenvectors of all modes together form the basis. The choice compares counted multiplications and not
// times, so that a scene takes the same route on every machine.
//
// The order q of the series at which a trace costs least.
//
// The error of the interpolant of order q is about (h / 2R)^(2q+2), with the step length h and the distance R
// of the nearest singularity. So a range of length L needs about L / R eps^(-1/(2q+2)) steps at tolerance
// eps, and a few more at the ends of the range and at special points. The cost of a point has a part that
// does not depend on the order (corrections, LU, certificate) and a part for the q + 1 coefficients of every
// series. The work is counted in multiplications and not timed, so that a scene gets the same order, and the
// same bits, on every machine. The counts were measured on the traces in docs/developers/accuracy.md.
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

/// Sizes on which the choice depends. It does not depend on the number of modes, because all modes cost the
/// same.
struct TraceSize {
  Eigen::Index freedoms = 0;  ///< size n of the reduced pencil
  bool certify = true;
};

/// Number of points of a typical trace, up to a factor that is the same for all orders.
double relative_points(int order, double tolerance);

/// The order from 1 to 4 with the least work at this tolerance; the lowest one if several are equal.
int cheapest_order(const TraceSize& size, double tolerance);

}  // namespace eigentrail
