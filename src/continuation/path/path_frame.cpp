#include "continuation/path/path_frame.hpp"

#include <algorithm>
#include <limits>

#include "core/positive_or_one.hpp"
#include "core/series_composition.hpp"

namespace eigentrail {
namespace {

/// Cosine of the angle between the normal and the path up to which the plane is replaced, about that of 45
/// degrees: there a step along the normal still is 0.7 times the step along the path. Replacing it earlier
/// would only cost the work of rewriting all series.
constexpr double least_cosine = 0.7;
/// Growth of the position since it scaled the plane, from which the plane is replaced. Steps have the length
/// of this scale, so that far out they grow with it.
constexpr double outgrown = 2.0;
/// Distance of a pole, as a share of the range, from which on a path can be said to run to infinity: beside a
/// pole that is passed at a larger distance, the position becomes less again.
constexpr double beside_pole = 1e-5;
/// Growth of the position on a step towards a pole. Steps there have a quarter of its length; beside a fold
/// the position changes less.
constexpr double pole_growth = 1.02;
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

bool PathFrame::on_branch_point(double at) const {
  return bridge && std::abs(at - branch_point.coordinate) <= same_coordinate * coordinate_range();
}

Path PathFrame::path_on_bridge(double at, int order) const {
  const bool at_branch_point = on_branch_point(at);
  Path path = bridge->path(at_branch_point ? branch_point.coordinate : at, order);
  if (at_branch_point) path.parameters(range.traced, 0) = branch_point.p;
  return path;
}

void note_size(const Model& model, const PathNode& node, PathFrame& frame) {
  frame.largest_position = std::max(frame.largest_position, node.path.x.col(0).norm());
  if (model.n_trims() == 0) return;
  if (frame.largest_unknowns.size() == 0)
    frame.largest_unknowns = model.first_multipliers(model.description().parameters.declared_values())
                                 .tail(model.n_trims())
                                 .cwiseAbs()
                                 .unaryExpr(&positive_or_one);
  const Vector unknowns = node.path.lambda.col(0).tail(model.n_trims());
  frame.largest_unknowns = frame.largest_unknowns.cwiseMax(unknowns.cwiseAbs());
}

double remaining(const PathFrame& frame, const PathNode& node) {
  double length = std::numeric_limits<double>::max();
  if (frame.bridge && !frame.on_branch_point(node)) {
    const double ahead = frame.direction * (frame.branch_point.coordinate - frame.coordinate(node));
    if (ahead >= 0.0) length = ahead;
  }
  return frame.plane ? length : std::min(length, std::abs(frame.range.to - node.p));
}

bool reached_end(const PathFrame& frame, const PathNode& node) {
  const PathRange& range = frame.range;
  if (!frame.plane) return node.p == range.to;
  const bool outward = heading(frame, node, 1.0) * (range.to - range.from) > 0.0;
  return node.p == range.to || (node.p == range.from && !outward);
}

double fold_distance(const PathFrame& frame, const PathNode& node) {
  const auto& p = node.path.parameters;
  return -coefficient(p, frame.range.traced, 1) / (2.0 * coefficient(p, frame.range.traced, 2));
}

double heading(const PathFrame& frame, const PathNode& node, double towards) {
  // On a pitchfork p turns at the branch point, whose place rounding moves by more than that of a fold.
  constexpr double at_branch_point = 1e-3;  // of `towards`
  const double least = frame.on_branch_point(node) ? at_branch_point * std::abs(towards) : 0.0;
  const bool on_it = std::abs(fold_distance(frame, node)) <= std::max(on_fold, least);
  return on_it ? 2.0 * coefficient(node.path.parameters, frame.range.traced, 2) * towards : frame.speed(node);
}

std::optional<double> turn_to_plane(const PathProblem& problem, PathFrame& frame, PathNode& node, double h) {
  if (frame.plane || problem.structure.fixed_equilibrium || problem.structure.known_equilibrium)
    return std::nullopt;
  if (frame.on_bridge(node)) return std::nullopt;
  const PathPlane plane = plane_along(node.path, problem.traced, frame.scales(), frame.direction);
  Path turned = node.path;
  reparametrize(turned, plane, problem.traced);
  if (!falls_faster(turned, node.path, problem.traced, frame.scales(), h)) return std::nullopt;
  frame.plane = plane;
  frame.scaled_at = frame.scales().x;
  frame.bridge.reset();
  frame.direction = 1.0;
  reparametrize(node, plane, problem.traced);
  return std::abs(h / coefficient(turned.parameters, problem.traced, 1));
}

bool renew_plane(PathFrame& frame, PathNode& node) {
  const int traced = frame.range.traced;
  if (!frame.plane) return false;
  const bool has_grown = frame.scaled_at > 0.0 && frame.largest_position > outgrown * frame.scaled_at;
  if (!has_grown && slant(*frame.plane, node.path, traced, frame.scales()) > least_cosine) return false;
  if (frame.on_bridge(node)) return false;
  frame.bridge.reset();
  frame.plane = plane_along(node.path, traced, frame.scales(), 1.0);
  frame.scaled_at = frame.scales().x;
  reparametrize(node, *frame.plane, traced);
  return true;
}

bool grows_towards_pole(const PathFrame& frame, const PathNode& previous, const PathNode& node) {
  if (!frame.plane) return false;
  const Vector x = node.path.x.col(0);
  const double size = x.norm();
  if (!(size > pole_growth * previous.path.x.col(0).norm() && size >= frame.largest_position)) return false;
  // |x| = a / (pole - p) has |x| / (d|x|/dp) = pole - p.
  const double growth = x.dot(node.path.x.col(1)) / x.squaredNorm();
  return std::abs(frame.speed(node)) < beside_pole * frame.range.length() * growth;
}

}  // namespace eigentrail
