#include "stability/curve_step.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bisection.hpp"
#include "core/series_composition.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/modes/invariants.hpp"

namespace eigentrail {
namespace {

/// Least cosine of the angle between the tangents at the ends and the chord.
constexpr double least_cosine = 0.2;
/// The error of s counts for eigenvalues of a pair that differ by at least this multiple of |s|; closer ones
/// are treated as if they differed by that much (root_error in invariants.hpp).
constexpr double least_gap_share = 0.1;

/// Series of place, tau and delta at a point in the distance along the chord, which has the unit direction
/// `chord`: the series in u composed with the inverse of the series of that distance.
Matrix in_chord(const CurvePoint& point, const Place& chord) {
  const Eigen::Index count = point.places.cols();
  Vector sigma = (chord.transpose() * point.places).transpose();
  sigma[0] = 0.0;
  Matrix series = Matrix::Zero(4, count);
  series.topRows(2) = point.places;
  // For divergence the block's only function is g, and tau = delta = 0 along the curve.
  if (point.functions.rows() > 1) series.bottomRows(2) = point.functions.topRows(2).real();
  compose_columns(series, power_table(reversion(sigma)));
  return series;
}

HermiteInterpolant interpolant(double length, const Matrix& left, const Matrix& right, Eigen::Index count) {
  return {length, left.leftCols(count).cast<Complex>(), right.leftCols(count).cast<Complex>()};
}

/// Values of t at which P (row 0) or Q (row 1) has a turning point, by bisection of the derivative between
/// samples.
std::vector<double> turning_points(const HermiteInterpolant& dense, Eigen::Index row) {
  constexpr int samples = 16;
  constexpr int halvings = 40;
  const auto slope = [&](double t) { return dense.slope(t)[row].real(); };
  std::vector<double> found;
  for (int i = 0; i < samples; ++i) {
    const double from = static_cast<double>(i) / samples;
    const double to = (i + 1.0) / samples;
    const double sign = slope(from);
    if (sign * slope(to) >= 0.0) continue;
    found.push_back(bisected(from, to, halvings, [&](double t) { return slope(t) * sign > 0.0; }).last);
  }
  return found;
}

}  // namespace

std::optional<ChordStep> make_chord_step(const CurvePoint& left, const CurvePoint& right) {
  const Place chord = right.place() - left.place();
  ChordStep step;
  step.length = chord.norm();
  const Place direction = chord / step.length;
  if (!(left.tangent().dot(direction) > least_cosine && right.tangent().dot(direction) > least_cosine))
    return std::nullopt;
  step.left = in_chord(left, direction);
  step.right = in_chord(right, direction);
  if (left.functions.rows() > 1)
    step.rounding = function_rounding(left.mode.Lambda[0]).cwiseMax(function_rounding(right.mode.Lambda[0]));
  return step;
}

Eigen::Vector4d ChordStep::operator()(double t) const {
  return interpolant(length, left, right, left.cols() - 1)(t).real();
}

Place ChordStep::slope(double t) const {
  return interpolant(length, left, right, left.cols() - 1).slope(t).real().head<2>();
}

Matrix ChordStep::series(double t0) const {
  return interpolant(length, left, right, left.cols() - 1)
      .series(t0, static_cast<int>(left.cols()) - 1)
      .real();
}

double ChordStep::error(double tolerance, double s_ref) const {
  const Vector errors = interpolant(length, left, right, left.cols()).error_without_last();
  const double place = std::max(errors[0], errors[1]) / tolerance;
  const Vector of_functions = (errors.tail<2>() - rounding).cwiseMax(0.0);
  double roots = 0.0;
  for (const Matrix* end : {&left, &right}) {
    const ComplexVector functions = end->col(0).tail(2).cast<Complex>();
    const double s = block_roots(functions).cwiseAbs().maxCoeff();
    const double scale = std::max(s, s_ref);
    roots =
        std::max(roots, root_error(functions, of_functions, least_gap_share * scale) / (tolerance * scale));
  }
  return std::max(place, roots);
}

BoundaryStep stored_step(const Window& window, const ChordStep& step) {
  BoundaryStep stored;
  stored.length = step.length;
  stored.left = step.left.leftCols(step.left.cols() - 1);
  stored.right = step.right.leftCols(step.right.cols() - 1);
  for (Matrix* end : {&stored.left, &stored.right}) {
    const Place first = window.declared(end->col(0).head<2>());
    for (Eigen::Index k = 1; k < end->cols(); ++k)
      end->col(k).head<2>() = window.declared_direction(end->col(k).head<2>());
    end->col(0).head<2>() = first;
  }
  return stored;
}

BoundaryStep boundary_step(double length, const double* series, Eigen::Index orders) {
  using Rows = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> ends(series, 4, 2 * orders);
  return {length, ends.leftCols(orders), ends.rightCols(orders)};
}

Eigen::Vector4d evaluate_step(const BoundaryStep& step, double t) {
  return interpolant(step.length, step.left, step.right, step.left.cols())(t).real();
}

std::pair<Place, Place> BoundaryCurve::extent() const {
  Place low = Place::Constant(INFINITY);
  Place high = -low;
  const auto take = [&](Eigen::Index row, double value) {
    low[row] = std::min(low[row], value);
    high[row] = std::max(high[row], value);
  };
  for (const BoundaryPoint& point : points) {
    for (Eigen::Index row = 0; row < 2; ++row) take(row, point.place[row]);
  }
  for (const BoundaryStep& step : steps) {
    const HermiteInterpolant dense = interpolant(step.length, step.left, step.right, step.left.cols());
    for (Eigen::Index row = 0; row < 2; ++row) {
      for (const double t : turning_points(dense, row)) take(row, dense(t)[row].real());
    }
  }
  return {low, high};
}

double distance_from(const ChordStep& step, const Place& place, double& t) {
  const Place from = step.left.col(0).head<2>();
  const Place to = step.right.col(0).head<2>();
  t = (place - from).dot(to - from) / (step.length * step.length);
  constexpr double slack = 1e-9;
  if (!(t >= -slack && t <= 1.0 + slack)) return INFINITY;
  t = std::clamp(t, 0.0, 1.0);
  return (step.place(t) - place).norm();
}

}  // namespace eigentrail
