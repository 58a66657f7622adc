// Which order of the series makes a trace cheapest.
//
// The error of the interpolant of order q falls like (h / 2R)^(2q+2) with the step h and the distance R of
// the nearest singularity, so at tolerance eps the steps number L / R eps^(-1/(2q+2)), and a few more that
// the ends and special points ask for. Each point costs what no order changes (corrections, LU, certificate)
// and q + 1 coefficients of every series. The work is counted in multiplications, not timed: the same scene
// gives the same order, and the same bits, on every machine. The counts are those of the traces in
// docs/developers/accuracy.md.
#pragma once

#include <Eigen/Core>

namespace eigentrail {

/// Sizes on which the choice depends. The number of modes is none of them: each costs the same.
struct TraceSize {
  Eigen::Index freedoms = 0;  ///< of the reduced pencil
  bool certify = true;
};

/// Multiplications of reals per mode and point whose dense output is of order q, 1 to 4.
double work_per_point(const TraceSize& size, int order);

/// Points of a trace of ordinary length, up to a factor that is the same for all orders.
double relative_points(int order, double tolerance);

/// The order from 1 to 4 of least work at this tolerance, the lowest one where several are equal.
int cheapest_order(const TraceSize& size, double tolerance);

}  // namespace eigentrail
