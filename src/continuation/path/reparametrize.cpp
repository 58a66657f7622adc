#include "continuation/path/reparametrize.hpp"

#include <algorithm>
#include <cmath>

#include "core/series_composition.hpp"

namespace eigentrail {
namespace {

/// Largest ratio of the last terms of the two series at which the coordinate is changed. Ahead of a
/// fold the series in p converges slowly and the ratio is small; elsewhere p is the simpler coordinate.
constexpr double bending_back = 3e-3;

/// Substitutes the coordinate in all series of the path. `table`: powers of the old coordinate in the new
/// one.
void compose(Path& path, const Matrix& table) {
  compose_columns(path.parameters, table);
  compose_columns(path.x, table);
  compose_columns(path.lambda, table);
}

/// The plane's coordinate, zero at the point, as a series in the present coordinate.
Vector coordinate_series(const Path& path, const PathPlane& plane, int traced, Eigen::Index count) {
  Vector sigma = Vector::Zero(count);
  for (Eigen::Index k = 1; k < count; ++k) {
    sigma[k] = plane.p * coefficient(path.parameters, traced, k);
    if (k < path.x.cols()) sigma[k] += plane.x.dot(path.x.col(k));
  }
  return sigma;
}

}  // namespace

PathPlane plane_along(const Path& path, int traced, const PathScales& scales, double direction) {
  const Vector dx = path.x.cols() > 1 ? Vector(path.x.col(1)) : Vector(Vector::Zero(path.x.rows()));
  const double dp = coefficient(path.parameters, traced, 1);
  const double norm = direction * std::hypot(dx.norm() / scales.x, dp / scales.p);
  return {dx / (scales.x * scales.x * norm), dp / (scales.p * scales.p * norm)};
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
  }
}

bool falls_faster(const Path& turned, const Path& path, int traced, const PathScales& scales, double h) {
  const Eigen::Index last = path.x.cols() - 1;
  if (last < 2) return false;
  const double sigma = std::abs(h / coefficient(turned.parameters, traced, 1));
  const auto tail = [&](const Path& series, double step) {
    const double x = series.x.col(last).norm() / scales.x;
    const double p = std::abs(coefficient(series.parameters, traced, last)) / scales.p;
    return std::max(x, p) * std::pow(step, static_cast<double>(last));
  };
  const double before = tail(path, std::abs(h));
  return tail(turned, sigma) < bending_back * before;
}

double slant(const PathPlane& plane, const Path& path, int traced, const PathScales& scales) {
  const double dp = coefficient(path.parameters, traced, 1);
  const Vector dx = path.x.cols() > 1 ? Vector(path.x.col(1)) : Vector(Vector::Zero(path.x.rows()));
  const double tangent = std::hypot(dx.norm() / scales.x, dp / scales.p);
  const double normal = std::hypot(plane.x.norm() * scales.x, plane.p * scales.p);
  return (plane.x.dot(dx) + plane.p * dp) / (tangent * normal);
}

}  // namespace eigentrail
