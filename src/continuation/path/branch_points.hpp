// Branch points: where another equilibrium path crosses, the trace builds a bridge over the point and ends a
// step on it.
//
// Test function: det of the bordered steady equations changes its sign at a branch point, and at none of the
// folds. In the path's coordinate it is det(T^T K T) / (dp / dsigma), of which a point has series.
#pragma once

#include "continuation/point/point_solver.hpp"

namespace eigentrail {

/// A solved point of the path on one side of a branch point, with all coefficients that a series may have;
/// nothing about modes.
struct SidePoint {
  double coordinate = 0.0;
  Path path;
  double heading = 1.0;                ///< dp/dsigma
  double sign = 0.0, logarithm = 0.0;  ///< of det T^T K T
};

/// The side point that a reduced point is; nothing when it was not solved, or has other freedoms than
/// `n_freedoms`.
std::optional<SidePoint> side_point(const PointSolver& solver, const PathPoint& point,
                                    Eigen::Index n_freedoms);

/// Magnitudes by which errors of a bridge are measured at a point. Multipliers count by their forces.
Bridge::Sizes bridge_sizes(const PathFrame& frame, const PathNode& node);

/// Whether the model's equilibrium moves with the parameter, so that there can be branch points and folds.
bool equilibrium_moves(const PathProblem& problem);

/// Looks for a branch point on the step of length h from `node`, or just behind it, and builds a bridge over
/// it in the frame. `next` is the end of the step, null where it was not found: then the series of `node`
/// tell alone. `tries`: bridges looked for from this node so far. Returns whether there is a new bridge.
bool bridge_branch_point(const PointSolver& solver, PathFrame& frame, const PathNode& node, double h,
                         const PathNode* next, int& tries);

/// A trace that begins on a branch point begins on the path that passes it in p: the reduced point there,
/// and a bridge in the frame. Nothing where the point is no branch point.
std::optional<PathPoint> bridge_start(const PointSolver& solver, PathFrame& frame, const PathPoint& point);

}  // namespace eigentrail
