#include "continuation/path/reparametrize.hpp"

#include <algorithm>
#include <cmath>

#include "core/series_composition.hpp"

namespace eigentrail {
namespace {

/// Largest ratio of the last terms of the two series at which the coordinate is changed. Ahead of a
/// fold the series in p converges slowly and the ratio is small; elsewhere p is the simpler coordinate.
constexpr double bending_back = 3e-3;

/// Motion on a step, over the scale of x, up to which x rests: then the trimmed parameters tell whether the
/// path turns back. Where x moves it tells, and u may have series of its own, such as a square root of the
/// load.
constexpr double no_path_motion = 1e-6;

/// Substitutes the coordinate in all series of the path. `table`: powers of the old coordinate in the new
/// one.
void compose(Path& path, const Matrix& table) {
  compose_columns(path.parameters, table);
  compose_columns(path.x, table);
  compose_columns(path.lambda, table);
}

/// A direction in (x, u, p), u the trimmed parameters that have a scale.
struct Direction {
  Vector x, u;
  double p = 0.0;

  /// In scaled coordinates.
  double length(const PathScales& scales) const {
    return std::hypot(std::hypot(x.norm() / scales.x, u.cwiseQuotient(scales.u).norm()), p / scales.p);
  }
};

/// The coefficients of h^k of a path, with so many trimmed parameters.
Direction term(const Path& path, int traced, Eigen::Index unknowns, Eigen::Index k) {
  const bool has = k < path.x.cols();
  return {has ? Vector(path.x.col(k)) : Vector(Vector::Zero(path.x.rows())),
          has ? Vector(path.lambda.col(k).tail(unknowns)) : Vector(Vector::Zero(unknowns)),
          coefficient(path.parameters, traced, k)};
}

/// The plane's coordinate, zero at the point, as a series in the present coordinate.
Vector coordinate_series(const Path& path, const PathPlane& plane, int traced, Eigen::Index count) {
  Vector sigma = Vector::Zero(count);
  for (Eigen::Index k = 1; k < count; ++k) {
    const Direction c = term(path, traced, plane.u.size(), k);
    sigma[k] = plane.p * c.p + plane.x.dot(c.x) + plane.u.dot(c.u);
  }
  return sigma;
}

}  // namespace

PathPlane plane_along(const Path& path, int traced, const PathScales& scales, double direction) {
  const Direction tangent = term(path, traced, scales.u.size(), 1);
  const double norm = direction * tangent.length(scales);
  return {tangent.x / (scales.x * scales.x * norm), tangent.p / (scales.p * scales.p * norm),
          tangent.u.cwiseQuotient(scales.u).cwiseQuotient(scales.u) / norm};
}

void reparametrize(Path& path, const PathPlane& plane, int traced) {
  const Vector sigma = coordinate_series(path, plane, traced, std::max<Eigen::Index>(2, path.x.cols()));
  compose(path, power_table(reversion(sigma)));
}

void reparametrize(PathNode& node, const PathPlane& plane, int traced) {
  Eigen::Index count = std::max<Eigen::Index>(2, node.path.x.cols());
  for (const Track& track : node.tracks) count = std::max(count, track.functions.cols());
  const Vector sigma = coordinate_series(node.path, plane, traced, count);
  const Matrix table = power_table(reversion(sigma));
  compose(node.path, table);
  for (SystemSeries* series :
       {&node.linearization.M, &node.linearization.C, &node.linearization.K, &node.linearization.A})
    compose(*series, table);
  for (MatrixSeries* series : {&node.basis.T, &node.pencil.M, &node.pencil.C, &node.pencil.K})
    compose(*series, table);
  for (Track& track : node.tracks) {
    compose_columns(track.functions, table);
    compose(track.series.Z, table);
    compose(track.series.Lambda, table);
    if (track.departure) track.departure->distance *= sigma[1];
    track.hidden_within *= std::abs(sigma[1]);
  }
}

bool falls_faster(const Path& turned, const Path& path, int traced, const PathScales& scales, double h) {
  const Eigen::Index last = path.x.cols() - 1;
  if (last < 2) return false;
  const double sigma = std::abs(h / coefficient(turned.parameters, traced, 1));
  const bool rests = scales.u.size() > 0 && path.x.col(1).norm() * std::abs(h) <= no_path_motion * scales.x;
  const auto tail = [&](const Path& series, double step) {
    const Direction end = term(series, traced, scales.u.size(), last);
    const double x = rests ? Direction{Vector(), end.u}.length(scales) : end.x.norm() / scales.x;
    const double p = std::abs(end.p) / scales.p;
    return std::max(x, p) * std::pow(step, static_cast<double>(last));
  };
  const double before = tail(path, std::abs(h));
  return tail(turned, sigma) < bending_back * before;
}

double slant(const PathPlane& plane, const Path& path, int traced, const PathScales& scales) {
  const Direction tangent = term(path, traced, scales.u.size(), 1);
  const double normal = std::hypot(
      std::hypot(plane.x.norm() * scales.x, plane.u.cwiseProduct(scales.u).norm()), plane.p * scales.p);
  const double along = plane.x.dot(tangent.x) + plane.p * tangent.p + plane.u.dot(tangent.u);
  return along / (tangent.length(scales) * normal);
}

}  // namespace eigentrail
