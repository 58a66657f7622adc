// A change of the coordinate along the path: all series of a point in terms of the distance across a plane.
#pragma once

#include "eigentrail/continuation/path_point.hpp"

namespace eigentrail {

/// Lengths that x and p are measured by along the path.
struct PathScales {
  double x = 1.0, p = 1.0;
};

/// The plane across the path at the point of a series.
/// `direction` is the sign with which the series is travelled.
PathPlane plane_along(const Path& path, int traced, const PathScales& scales, double direction);

/// Rewrites every series of the point in the plane's coordinate.
void reparametrize(PathNode& node, const PathPlane& plane, int traced);

/// The same for the path alone.
void reparametrize(Path& path, const PathPlane& plane, int traced);

/// Whether the last term of x falls much faster in the coordinate of `turned` than in that of `path` on a
/// step whose length in the latter is h.
bool falls_faster(const Path& turned, const Path& path, int traced, const PathScales& scales, double h);

/// Cosine between the plane's normal and the path, in scaled coordinates.
double slant(const PathPlane& plane, const Path& path, int traced, const PathScales& scales);

}  // namespace eigentrail
