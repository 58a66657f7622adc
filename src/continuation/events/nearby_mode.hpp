// A mode and its series at a place between the points of the trace, for Newton's method that locates an
// event.
#pragma once

#include "continuation/point/point_solver.hpp"

namespace eigentrail {

struct NearbyMode {
  SolvedPoint solved;    ///< the point; its node has only the track of the mode
  Complex root;          ///< the eigenvalue in the chart of the track, the upper member of a pair
  ComplexVector series;  ///< Taylor coefficients of the eigenvalue; empty where it is not simple
  double gap = 0.0;      ///< least distance of two eigenvalues of the block; infinite for a single mode
  bool is_mean = false;  ///< `series` is the mean of a complex pair, smooth also where the pair is defective
};

/// The eigenvalue of a track at the distance h from `left` that is nearest to `expected`, in its chart.
/// `of_pair`: only the real part of a complex pair is needed; it has a series also where the pair is
/// defective. Empty where no point is found.
std::optional<NearbyMode> look_at_mode(const PointSolver& solver, const PathNode& left, std::size_t track,
                                       Complex expected, double h, bool of_pair);

/// mu or its conjugate: the one of the member with Im s >= 0, where mu = s or 1/s by the chart.
Complex upper_member(Complex mu, Chart chart);

}  // namespace eigentrail
