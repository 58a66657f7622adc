// Time of the usual method, for comparison ("rival"): eigenvalues on a grid, modes matched from point to
// point, and a cubic spline through each mode.
#pragma once

#include "bench/timed_trace.hpp"

namespace eigentrail::test {

/// Least number of equally spaced points (within 3 %) at which a spline through exact, rightly labelled
/// eigenvalues has at most the error `wanted` at `tests`; the exact ones are those of `exact`. Throws
/// std::runtime_error beyond 10^6 points.
int points_for_spline(const Recording& exact, const TraceOptions& range, const std::vector<double>& tests,
                      double wanted);

struct RivalTime {
  double seconds = 0.0;  ///< for all points
  int measured = 0;      ///< points that were computed for it; the rest is scaled
};

/// QZ with vectors at `points` parameters, modal assurance criterion and Hungarian matching from each to the
/// next, a spline at the end. At most `most` points are computed.
RivalTime time_grid(const Setting& setting, const TraceOptions& range, int points, int most);

/// Shift-and-invert Arnoldi about the mean of the followed modes at every point; no matching, one cluster.
/// As many Arnoldi steps as the modes need at the range's beginning for an accuracy `accuracy`.
struct ArnoldiTime : RivalTime {
  int steps = 0;  ///< solves per point
};
ArnoldiTime time_arnoldi(const Setting& setting, const TraceOptions& range, const Recording& exact,
                         double accuracy, int points, int most);

}  // namespace eigentrail::test
