// Detection of branch points, where another equilibrium path crosses. The trace represents its own path over
// such a point by a bridge (bridge.hpp) and ends a step on the point.
//
// Test function: the determinant of the steady equations bordered by the path's plane. It changes sign at a
// branch point, but not at a fold. Up to a factor without a change of sign it is det(T^T K T) / (dp /
// dsigma), with the coordinate sigma along the path. Both terms follow from the series at a point.
//
// A projected scene spans few of the motions of the whole. Its own stiffness is singular elsewhere than that
// of the whole, whose equilibrium the path consists of: a structure may buckle in a motion that is none of
// the followed modes. So there it is the determinant of the whole, [K, A^T; A, 0], by sparse LU; both
// determinants have the same zeros and signs up to a constant factor.
#pragma once

#include "continuation/point/point_solver.hpp"
#include "eigentrail/core/log_determinant.hpp"

namespace eigentrail {

/// A point of the path on one side of a branch point, without modes.
struct SidePoint {
  double coordinate = 0.0;
  Path path;                 ///< series of the highest order, max_order
  double heading = 1.0;      ///< dp/dsigma
  LogDeterminant stiffness;  ///< det T^T K T
};

/// The side point from a reduced point. Empty if that was not computed, does not have `n_freedoms` freedoms,
/// or has no finite series.
std::optional<SidePoint> side_point(const PointSolver& solver, const PathPoint& point,
                                    Eigen::Index n_freedoms);

/// Magnitudes by which errors of a bridge at a point are divided: the scales of x and p, and |K| |x| / |A|
/// for the multipliers lambda.
Bridge::Sizes bridge_sizes(const PathFrame& frame, const PathNode& node);

/// Whether the equilibrium depends on the parameter and is solved for. Only then can there be branch points
/// and folds.
bool equilibrium_moves(const PathProblem& problem);

/// Searches for a branch point on the step of signed length h from `node`, or a little beyond its end, and
/// builds a bridge over it in the frame. `next`: end of the step; null if it was not found, and then the test
/// function is extrapolated from `node`. `tries`: number of attempts from this node, increased by an attempt;
/// after three there are no more. Returns whether there is a new bridge.
bool bridge_branch_point(const PointSolver& solver, PathFrame& frame, const PathNode& node, double h,
                         const PathNode* next, int& tries);

/// Whether the stiffness is singular at a point, where paths may cross.
bool is_on_branch_point(const PathProblem& problem, const PathPoint& point);

/// For a trace that begins on a branch point: builds a bridge in the frame along the path that can be
/// followed in p, and returns the reduced point on it. Empty if the point is not a branch point.
std::optional<PathPoint> bridge_start(const PointSolver& solver, PathFrame& frame, const PathPoint& point);

}  // namespace eigentrail
