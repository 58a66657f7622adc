// The order q of the series at which a trace costs least.
//
// The error of the interpolant of order q is about (h / 2R)^(2q+2), with the step length h and the distance R
// of the nearest singularity. So a range of length L needs about L / R eps^(-1/(2q+2)) steps at tolerance
// eps, and a few more at the ends of the range and at special points. The cost of a point has a part that
// does not depend on the order (corrections, LU, certificate) and a part for the q + 1 coefficients of every
// series. The work is counted in multiplications and not timed, so that a scene gets the same order, and the
// same bits, on every machine. The counts were measured on the traces in docs/developers/accuracy.md.
#pragma once

#include <Eigen/Core>

namespace eigentrail {

/// Sizes on which the choice depends. It does not depend on the number of modes, because all modes cost the
/// same.
struct TraceSize {
  Eigen::Index freedoms = 0;  ///< size n of the reduced pencil
  bool certify = true;
};

/// Multiplications of real numbers per mode and point, with dense output of order q, 1 to 4.
double work_per_point(const TraceSize& size, int order);

/// Number of points of a typical trace, up to a factor that is the same for all orders.
double relative_points(int order, double tolerance);

/// The order from 1 to 4 with the least work at this tolerance; the lowest one if several are equal.
int cheapest_order(const TraceSize& size, double tolerance);

}  // namespace eigentrail
