#include "continuation/reparametrize.hpp"

#include <algorithm>
#include <cmath>

#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Series of the old coordinate in the new one: the inverse function of sigma(h), sigma_0 = 0.
Vector reversion(const Vector& sigma) {
  const Eigen::Index count = sigma.size();
  Vector h = Vector::Zero(count);
  h[1] = 1.0 / sigma[1];
  for (Eigen::Index k = 2; k < count; ++k) {
    // sigma(h(u)) = u: coefficient k with h_k = 0 is what h_k has to remove.
    Vector power = Vector::Zero(count);
    power[0] = 1.0;
    double sum = 0.0;
    for (Eigen::Index j = 1; j <= k; ++j) {
      Vector next = Vector::Zero(count);
      for (Eigen::Index a = 0; a < count; ++a) {
        for (Eigen::Index b = 0; a + b < count; ++b) next[a + b] += power[a] * h[b];
      }
      power = next;
      sum += sigma[j] * power[k];
    }
    h[k] = -sum / sigma[1];
  }
  return h;
}

/// Row j: coefficients of h(u)^j.
Matrix powers(const Vector& h) {
  const Eigen::Index count = h.size();
  Matrix table = Matrix::Zero(count, count);
  table(0, 0) = 1.0;
  for (Eigen::Index j = 1; j < count; ++j) {
    for (Eigen::Index a = 0; a < count; ++a) {
      for (Eigen::Index b = 0; a + b < count; ++b) table(j, a + b) += table(j - 1, a) * h[b];
    }
  }
  return table;
}

/// Columns are coefficients.
template <class Series>
void compose_columns(Series& series, const Matrix& table) {
  if (series.cols() <= 1) return;
  const Series old = series;
  series = Series::Zero(old.rows(), table.cols());
  for (Eigen::Index j = 0; j < old.cols(); ++j) series += old.col(j) * table.row(j);
}

template <class Coefficient>
void compose(std::vector<Coefficient>& series, const Matrix& table) {
  if (series.size() <= 1) return;
  const std::vector<Coefficient> old = series;
  series.assign(static_cast<std::size_t>(table.cols()), Coefficient::Zero(old[0].rows(), old[0].cols()));
  for (std::size_t j = 0; j < old.size(); ++j) {
    for (std::size_t k = 0; k < series.size(); ++k)
      series[k] += table(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) * old[j];
  }
}

void compose(Path& path, const Matrix& table) {
  compose_columns(path.parameters, table);
  compose_columns(path.x, table);
  compose_columns(path.lambda, table);
}

/// The plane's coordinate, zero at the point, as a series in the path's own.
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
  compose(path, powers(reversion(sigma)));
}

void reparametrize(PathNode& node, const PathPlane& plane, int traced) {
  Eigen::Index count = std::max<Eigen::Index>(2, node.path.x.cols());
  for (const Track& track : node.tracks) count = std::max(count, track.functions.cols());
  const Vector sigma = coordinate_series(node.path, plane, traced, count);
  const Matrix table = powers(reversion(sigma));
  compose(node.path, table);
  for (MatrixSeries* series :
       {&node.linearization.M, &node.linearization.C, &node.linearization.K, &node.linearization.A,
        &node.basis.T, &node.pencil.M, &node.pencil.C, &node.pencil.K})
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
  constexpr double bending_back = 3e-3;
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
