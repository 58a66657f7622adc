#include "accuracy/grid_interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace eigentrail {
namespace {

/// Second derivatives times step^2 / 6 of a cubic spline, m. They solve m_{i-1} + 4 m_i + m_{i+1} = d_i with
/// the second differences d_i of the values. The not-a-knot condition is m_0 - 2 m_1 + m_2 = 0. It gives
/// m_1 = d_1 / 6, and likewise at the other end.
std::vector<ComplexVector> spline_curvatures(const std::vector<ComplexVector>& values) {
  const std::size_t last = values.size() - 1;
  std::vector<ComplexVector> m(values.size());
  for (std::size_t i = 1; i < last; ++i) m[i] = values[i - 1] - 2.0 * values[i] + values[i + 1];
  m[1] /= 6.0;
  m[last - 1] /= 6.0;
  // Gaussian elimination of the tridiagonal equations for m_2 ... m_{last - 2}.
  std::vector<double> pivot(values.size(), 4.0);
  m[2] -= m[1];
  m[last - 2] -= m[last - 1];
  for (std::size_t i = 3; i + 1 < last; ++i) {
    pivot[i] -= 1.0 / pivot[i - 1];
    m[i] -= m[i - 1] / pivot[i - 1];
  }
  m[last - 2] /= pivot[last - 2];
  for (std::size_t i = last - 2; i-- > 2;) m[i] = (m[i] - m[i + 1]) / pivot[i];
  m[0] = 2.0 * m[1] - m[2];
  m[last] = 2.0 * m[last - 1] - m[last - 2];
  return m;
}

}  // namespace

GridInterpolant::GridInterpolant(double first, double step, std::vector<ComplexVector> values,
                                 Interpolation kind)
    : first_(first), step_(step), values_(std::move(values)) {
  const std::size_t least = kind == Interpolation::linear ? 2 : 5;
  if (values_.size() < least) {
    throw std::invalid_argument("GridInterpolant: expected at least " + std::to_string(least) +
                                " points, got " + std::to_string(values_.size()));
  }
  if (kind == Interpolation::cubic_spline) curvatures_ = spline_curvatures(values_);
}

ComplexVector GridInterpolant::operator()(double p) const {
  const double place = (p - first_) / step_;
  const double most = static_cast<double>(values_.size() - 2);
  const auto k = static_cast<std::size_t>(std::clamp(std::floor(place), 0.0, most));
  const double t = place - static_cast<double>(k);
  const double u = 1.0 - t;
  ComplexVector result = u * values_[k] + t * values_[k + 1];
  if (!curvatures_.empty()) result += (u * u * u - u) * curvatures_[k] + (t * t * t - t) * curvatures_[k + 1];
  return result;
}

}  // namespace eigentrail
