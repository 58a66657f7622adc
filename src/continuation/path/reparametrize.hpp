// Change of the coordinate along the path: composition of all series of a point with the series of the old
// coordinate in the new one, the distance across a plane.
#pragma once

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Scales by which x and p are divided, and trimmed parameters, each by its own.
struct PathScales {
  double x = 1.0, p = 1.0;
  Vector u = {};
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

}  // namespace eigentrail
