#include "model/beam_axis.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/gaps.hpp"

namespace eigentrail {
namespace {

/// Sum of weights times values.
Expression weighted(const std::vector<double>& weights, const std::vector<Expression>& values) {
  Expression sum(0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) sum = sum + Expression(weights[i]) * values[i];
  return sum;
}

/// Derivative at station i of the parabola through three neighbouring stations: weights of the stations.
std::vector<double> parabola_slope(const std::vector<double>& x, std::size_t i) {
  std::vector<double> weights(x.size(), 0.0);
  if (x.size() == 2) return {-1.0 / (x[1] - x[0]), 1.0 / (x[1] - x[0])};
  const std::size_t first = std::min(i == 0 ? 0 : i - 1, x.size() - 3);
  for (std::size_t a = first; a < first + 3; ++a) {
    const std::size_t b = first + (a - first + 1) % 3;
    const std::size_t c = first + (a - first + 2) % 3;
    weights[a] = (2.0 * x[i] - x[b] - x[c]) / ((x[a] - x[b]) * (x[a] - x[c]));
  }
  return weights;
}

/// Axes with x along a direction and y as close to the given one as it may be, turned about x.
ExpressionRotation section_axes(const ExpressionVector& along, const ExpressionVector& y,
                                const Expression& twist) {
  const ExpressionVector e = normalized(along);
  const ExpressionVector first = normalized(y - dot(y, e) * e);
  const ExpressionVector second = cross(e, first);
  const Expression c = cos(twist);
  const Expression s = sin(twist);
  return {e, c * first + s * second, c * second - s * first};
}

}  // namespace

std::vector<std::array<double, 2>> gauss_points(int n) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 1; k < n; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(jacobi);
  std::vector<std::array<double, 2>> points;
  for (int k = 0; k < n; ++k) {
    const double first = solver.eigenvectors()(0, k);
    points.push_back({0.5 * (1.0 + solver.eigenvalues()[k]), first * first});
  }
  return points;
}

ShapeFunctions shape_functions(int degree, double xi) {
  if (degree == 1) return {{1.0 - xi, xi}, {-1.0, 1.0}};
  return {{(1.0 - xi) * (1.0 - 2.0 * xi), 4.0 * xi * (1.0 - xi), xi * (2.0 * xi - 1.0)},
          {4.0 * xi - 3.0, 4.0 - 8.0 * xi, 4.0 * xi - 1.0}};
}

SmoothWeights smooth_weights(const std::vector<double>& span, double s) {
  const std::size_t right = gap_of(span, s) + 1;
  const double h = span[right] - span[right - 1];
  const double t = (s - span[right - 1]) / h;
  SmoothWeights result{std::vector<double>(span.size(), 0.0), std::vector<double>(span.size(), 0.0)};
  result.value[right - 1] = (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
  result.value[right] = t * t * (3.0 - 2.0 * t);
  result.slope[right - 1] = -6.0 * t * (1.0 - t) / h;
  result.slope[right] = 6.0 * t * (1.0 - t) / h;
  const std::vector<double> left_slope = parabola_slope(span, right - 1);
  const std::vector<double> right_slope = parabola_slope(span, right);
  for (std::size_t i = 0; i < span.size(); ++i) {
    result.value[i] += h * t * (1.0 - t) * ((1.0 - t) * left_slope[i] - t * right_slope[i]);
    result.slope[i] += (1.0 - t) * (1.0 - 3.0 * t) * left_slope[i] + t * (3.0 * t - 2.0) * right_slope[i];
  }
  return result;
}

Expression BeamAxis::stretch(int element, const ShapeFunctions& shape) const {
  if (straight) return Expression(1.0 / elements) * length;
  ExpressionVector tangent;
  for (std::size_t a = 0; a < shape.slope.size(); ++a)
    tangent = tangent + Expression(shape.slope[a]) * local_position[node(element, a)];
  return sqrt(dot(tangent, tangent));
}

BeamAxis beam_axis(const BeamTable& table, int elements, int degree, const ExpressionVector& from,
                   const ExpressionVector& to, const ExpressionVector& y) {
  BeamAxis axis{elements, degree, table.straight, table.twisted, {}, {}, {}, {}, {}};
  const ExpressionVector chord = to - from;
  axis.length = sqrt(dot(chord, chord));
  const ExpressionRotation base = section_axes(chord, y, 0.0);
  for (int i = 0; i < axis.nodes(); ++i) {
    const double s = static_cast<double>(i) / (axis.nodes() - 1);
    ExpressionVector position = {Expression(s) * axis.length, 0.0, 0.0};
    ExpressionVector tangent = unit_vector(0);
    if (!table.straight) {
      const SmoothWeights w = smooth_weights(table.span, s);
      position[1] = weighted(w.value, table.sweep);
      position[2] = weighted(w.value, table.prebend);
      tangent = {axis.length, weighted(w.slope, table.sweep), weighted(w.slope, table.prebend)};
    }
    Expression twist(0.0);
    for (const StationShare& share : table.shares(s))
      twist = twist + Expression(share.weight) * table.twist[share.station];
    const ExpressionRotation local = section_axes(tangent, unit_vector(1), twist);
    axis.local_position.push_back(position);
    axis.local_rotation.push_back(local);
    axis.position.push_back(table.straight ? from + Expression(s) * chord : from + turned(base, position));
    axis.rotation.push_back({turned(base, local[0]), turned(base, local[1]), turned(base, local[2])});
  }
  return axis;
}

}  // namespace eigentrail
