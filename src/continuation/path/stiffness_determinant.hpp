// The determinant of the stiffness T^T K T of what the constraints leave free: the test function for branch
// points.
//
// A projected scene spans few of the motions of the whole. Its own stiffness is singular elsewhere than that
// of the whole, whose equilibrium the path consists of: a structure may buckle in a motion that is none of
// the followed modes. So there it is the determinant of the whole, [K, A^T; A, 0], by sparse LU; both
// determinants have the same zeros and signs up to a constant factor.
#pragma once

#include <optional>

#include "eigentrail/continuation/path_point.hpp"
#include "steady/sparse_kkt.hpp"

namespace eigentrail {

/// At a point.
LogDeterminant stiffness_determinant(const PathProblem& problem, const PathPoint& point);

/// At a distance from a point, by its series.
LogDeterminant stiffness_determinant(const PathProblem& problem, const PathNode& node, double distance);

/// det T^T K T of the freedoms that are held, also of a projected scene, up to the last digit and divided by
/// the magnitude of another one: for the search of its zero.
double vanishing_determinant(const PathPoint& point, const LogDeterminant& unit);

/// singularity_test (steady/) of the whole stiffness of a projected scene, for the search of its zero.
class WholeSingularity {
 public:
  /// Zero also if there is no kernel. The first point should be the one closest to the zero.
  double operator()(const PathPoint& point);

 private:
  std::optional<KktKernel> kernel_;  ///< at the first point
};

/// Whether forces hold any freedom of a point.
bool holds_anything(const PathPoint& point);

}  // namespace eigentrail
