// The coordinate along the equilibrium path.
//
// It is the traced parameter p itself or, where the path turns back, the distance from a point along the
// normal of a plane in (x, u, p), u the trimmed parameters (pseudo-arclength, Keller 1977), called sigma.
// A change of the coordinate composes all series of a point with that of the old coordinate in the new one.
// Over a branch point, where the steady equations are singular, the path comes from a bridge (bridge.hpp).
#pragma once

#include <cmath>
#include <optional>

#include "continuation/path/bridge.hpp"
#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// The range of the traced parameter, in its unit, in the direction of the trace.
struct PathRange {
  int traced = 0;  ///< index of the parameter
  double from = 0.0, to = 0.0;

  double length() const { return std::abs(to - from); }
};

/// Scales by which x and p are divided, and trimmed parameters, each by its own.
struct PathScales {
  double x = 1.0, p = 1.0;
  Vector u = {};
};

/// The coordinate in use, with what belongs to it.
struct PathFrame {
  PathRange range;
  std::optional<PathPlane> plane = {};  ///< empty: the coordinate is p
  double direction = 1.0;               ///< sign of the steps in the coordinate
  double largest_position = 0.0;        ///< largest |x| on the path so far
  double scaled_at = 0.0;               ///< largest_position that scales the plane in use
  Vector largest_unknowns = {};         ///< largest magnitudes of the trimmed parameters so far
  std::vector<double> rounding = {};    ///< by mode, what was seen so far (step_error.hpp)
  std::optional<Bridge> bridge = {};    ///< in the coordinate of `plane`
  struct BranchPoint {
    double coordinate = 0.0, p = 0.0;
  } branch_point = {};  ///< on the bridge

  /// Value of the coordinate at a point of the path.
  double coordinate(const Vector& x, const Vector& lambda, double p) const {
    return plane ? (*plane)(x, lambda, p) : p;
  }
  double coordinate(const PathNode& node) const {
    return coordinate(node.path.x.col(0), node.path.lambda.col(0), node.p);
  }

  /// Approximate length of the range in the coordinate. Planes are scaled so that it is about one.
  double coordinate_range() const { return plane ? 1.0 : range.length(); }

  /// dp / d(coordinate) at a point.
  double speed(const PathNode& node) const { return coefficient(node.path.parameters, range.traced, 1); }

  /// Scales of x and p: the largest |x| so far, or one if that is zero, and the length of the range. The
  /// present |x| would not do, since it may pass zero. Likewise of the trimmed parameters.
  PathScales scales() const {
    return {largest_position > 0.0 ? largest_position : 1.0, range.length(), largest_unknowns};
  }

  /// Whether a coordinate, or that of a point, is that of the branch point on the bridge, up to rounding.
  bool on_branch_point(double coordinate) const;
  bool on_branch_point(const PathNode& node) const { return on_branch_point(coordinate(node)); }

  /// Whether a point lies on the bridge.
  bool on_bridge(const PathNode& node) const { return bridge && bridge->covers(coordinate(node)); }

  /// Series of the path at a coordinate on the bridge. At the branch point, coordinate and p are set to its
  /// exact values.
  Path path_on_bridge(double coordinate, int order) const;
};

/// The plane through the point whose normal is the tangent of the path, in scaled coordinates. `direction`:
/// sign of the steps in the coordinate of the series. The new coordinate increases along the path, by one per
/// scaled unit of length.
PathPlane plane_along(const Path& path, int traced, const PathScales& scales, double direction);

/// Rewrites all series of the point in the plane's coordinate. `traced`: index of the traced parameter.
void reparametrize(PathNode& node, const PathPlane& plane, int traced);

/// The same for the path only.
void reparametrize(Path& path, const PathPlane& plane, int traced);

/// Whether the last term of the series of x (of u where x rests) and p, scaled, is much smaller in the
/// coordinate of `turned` than in that of `path`, on a step that has the length h in the latter.
bool falls_faster(const Path& turned, const Path& path, int traced, const PathScales& scales, double h);

/// Cosine of the angle between the normal of the plane and the path, in scaled coordinates.
double slant(const PathPlane& plane, const Path& path, int traced, const PathScales& scales);

/// Takes the size of a point of the path into the frame's scales. Trimmed parameters are at least as large as
/// their guesses in the scene, or one.
void note_size(const Model& model, const PathNode& node, PathFrame& frame);

/// Coordinates closer than this, relative to the range, are equal up to rounding.
constexpr double same_coordinate = 1e-12;

/// Distance from a point to the branch point ahead on the bridge or, if the coordinate is p, to the end of
/// the range, whichever is less. The largest double if neither applies.
double remaining(const PathFrame& frame, const PathNode& node);

/// Whether the trace ends at the point: at the end of the range or, after turning back, at its beginning.
bool reached_end(const PathFrame& frame, const PathNode& node);

/// Estimated signed distance to the fold, where dp/dsigma = 0, from the first two derivatives of p.
double fold_distance(const PathFrame& frame, const PathNode& node);

/// dp/dsigma at a point. On a fold, where that is rounding, its approximate value at the signed distance
/// `towards` from the point.
double heading(const PathFrame& frame, const PathNode& node, double towards);

/// A point closer than this to a fold, in the coordinate sigma, lies on it. The place of a fold is known to
/// little better than the square root of rounding.
constexpr double on_fold = 1e-9;

/// Changes the coordinate from p to the distance across a plane if the series of the equilibrium converges
/// much faster in it, as it does where the path turns back. Rewrites the series of the point. Returns the
/// length in the new coordinate of a step of length h in p; empty if the coordinate is not changed.
std::optional<double> turn_to_plane(const PathProblem& problem, PathFrame& frame, PathNode& node, double h);

/// Whether the position grows from `previous` to `node` as if it became infinite at a p just ahead, like that
/// of an unbalanced rotor without damping at a critical speed. True on a single step also beside some folds.
bool grows_towards_pole(const PathFrame& frame, const PathNode& previous, const PathNode& node);

/// If the path is no longer close to the normal of the plane, replaces the plane by one whose normal is the
/// tangent of the path. Likewise if the position has outgrown its scale. Returns whether it did.
bool renew_plane(PathFrame& frame, PathNode& node);

}  // namespace eigentrail
