// The coordinate along the path.
//
// It is the traced parameter p itself, or, once the equilibrium path bends back, the distance across a plane
// in (x, p) (pseudo-arclength, Keller 1977). Over a branch point, where the steady equations are singular,
// a bridge gives the path (bridge.hpp).
#pragma once

#include <cmath>
#include <optional>

#include "continuation/path/bridge.hpp"
#include "continuation/path/reparametrize.hpp"

namespace eigentrail {

/// The range of the traced parameter, in its unit, in the direction of the trace.
struct PathRange {
  int traced = 0;  ///< index of the parameter
  double from = 0.0, to = 0.0;

  double length() const { return std::abs(to - from); }
};

struct PathFrame {
  PathRange range;
  std::optional<PathPlane> plane = {};  ///< empty: the coordinate is p
  double direction = 1.0;               ///< sign of the steps in the coordinate
  double largest_position = 0.0;        ///< largest |x| on the path so far
  std::optional<Bridge> bridge = {};    ///< in the coordinate of `plane`
  struct BranchPoint {
    double coordinate = 0.0, p = 0.0;
  } branch_point = {};  ///< on the bridge

  /// Value of the coordinate at a place of the path.
  double coordinate(const Vector& x, double p) const { return plane ? (*plane)(x, p) : p; }
  double coordinate(const PathNode& node) const { return coordinate(node.path.x.col(0), node.p); }

  /// Length of the range in the coordinate, roughly; planes are scaled so that it is about one.
  double coordinate_range() const { return plane ? 1.0 : range.length(); }

  /// dp / d(coordinate) at a point.
  double speed(const PathNode& node) const { return coefficient(node.path.parameters, range.traced, 1); }

  /// Lengths that x and p are measured by. One length serves the whole path: the largest position so far,
  /// since the present one may pass zero.
  PathScales scales() const { return {largest_position > 0.0 ? largest_position : 1.0, range.length()}; }

  /// Whether a coordinate is that of the branch point on the bridge, up to rounding.
  bool on_branch_point(double coordinate) const;
  bool on_branch_point(const PathNode& node) const { return on_branch_point(coordinate(node)); }

  /// Whether a point lies on the bridge.
  bool on_bridge(const PathNode& node) const { return bridge && bridge->covers(coordinate(node)); }

  /// The series of the path at a coordinate on the bridge; exactly that of the branch point there.
  Path path_on_bridge(double coordinate, int order) const;
};

/// Coordinates this close, relative to the range, are one: what rounding leaves of a coordinate.
constexpr double same_coordinate = 1e-12;

/// Length of the path ahead of a point up to the branch point on the bridge, or to the end of the range where
/// the coordinate is p; the largest double where neither is known.
double remaining(const PathFrame& frame, const PathNode& node);

/// Whether the trace ends at the point: at the end of the range, or back at its beginning.
bool reached_end(const PathFrame& frame, const PathNode& node);

/// Distance to the fold, where dp/dsigma = 0, as the first two coefficients of p tell it.
double fold_distance(const PathFrame& frame, const PathNode& node);

/// dp/dsigma beside a point, on the side of `towards`. On a fold its value at the point itself is rounding.
double heading(const PathFrame& frame, const PathNode& node, double towards);

/// A point that is nearer than this to a fold, in the scaled coordinate, lies on it: the place of a fold is
/// known to the root of rounding.
constexpr double on_fold = 1e-9;

/// Changes to the coordinate across a plane where the equilibrium's series falls much faster in it than in p:
/// there the path is bending back. Rewrites the series of the point. Returns the length of the next step
/// in the new coordinate for one of length h in p; nothing where p stays the coordinate.
std::optional<double> turn_to_plane(const PathProblem& problem, PathFrame& frame, PathNode& node, double h);

/// Replaces a plane that the path meets at a slant by one across the path. Returns whether it did.
bool renew_plane(PathFrame& frame, PathNode& node);

}  // namespace eigentrail
