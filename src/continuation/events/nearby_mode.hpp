// A mode and its series at a place between the points of the trace, for Newton's method that locates an
// event.
#pragma once

#include "continuation/point/point_solver.hpp"

namespace eigentrail {

/// The function of a mode whose zero is sought.
enum class ModeFunction {
  eigenvalue,
  pair_mean,  ///< real part of a complex pair: the mean of the block, smooth also where the pair is defective
  product  ///< of two eigenvalues of a real block, the mode's and the one it meets; smooth where they meet.
           ///< Their mean where one of them stays zero, and the product with it
};

struct NearbyMode {
  SolvedPoint solved;    ///< the point; its node has only the track of the mode
  Complex root;          ///< the eigenvalue in the chart of the track, the upper member of a pair
  ComplexVector series;  ///< Taylor coefficients of the function; empty where an eigenvalue is not simple
  double gap = 0.0;      ///< least distance of two eigenvalues of the block; infinite for a single mode
  bool is_mean = false;  ///< `series` is the mean of a complex pair, or of an eigenvalue and a constant zero
};

/// The eigenvalue of a track at the distance h from `left` that is nearest to `expected`, in its chart.
/// `wanted`: of a single mode or of a block to which it does not apply, the eigenvalue, except for a product,
/// which needs a real block. Empty where no point is found or the function does not exist.
std::optional<NearbyMode> look_at_mode(const PointSolver& solver, const PathNode& left, std::size_t track,
                                       Complex expected, double h, ModeFunction wanted);

/// The eigenvalue whose product with the eigenvalue `root` of a real block is real and which is nearest to
/// it: the conjugate, or another real one. Index among the roots of the track; -1 if there is none.
int partner_of_root(const Track& track, int root);

/// mu or its conjugate: the one of the member with Im s >= 0, where mu = s or 1/s by the chart.
Complex upper_member(Complex mu, Chart chart);

}  // namespace eigentrail
