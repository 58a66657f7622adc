// One mode at a point beside the path's own ones, as a series: what Newton's method for an event looks at.
#pragma once

#include "continuation/point/point_solver.hpp"

namespace eigentrail {

struct NearbyMode {
  SolvedPoint solved;    ///< its node has the mode's track only
  Complex root;          ///< of its chart, upper member of a pair
  ComplexVector series;  ///< of that; empty where the root is not simple
  double gap = 0.0;      ///< to the next one in the block
  bool is_mean = false;  ///< the series is the mean of a conjugate pair, smooth also where the pair meets
};

/// The eigenvalue of a track of `left` that is expected at distance h. `of_pair`: the real part of a complex
/// pair is wanted. Nothing where no point is found.
std::optional<NearbyMode> look_at_mode(const PointSolver& solver, const PathNode& left, std::size_t track,
                                       Complex expected, double h, bool of_pair);

/// The upper member of a conjugate pair, in the chart of mu = s or 1/s.
Complex upper_member(Complex mu, Chart chart);

}  // namespace eigentrail
