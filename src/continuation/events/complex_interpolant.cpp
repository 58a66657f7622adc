#include "continuation/events/complex_interpolant.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {

void ComplexInterpolant::add(double x, const ComplexVector& series) {
  for (Eigen::Index k = 0; k < series.size(); ++k) {
    x_.push_back(x);
    table_.push_back(series);
  }
  refresh();
}

/// Computes the divided differences; where all points of one coincide, it is a Taylor coefficient.
void ComplexInterpolant::refresh() {
  const std::size_t n = x_.size();
  std::vector<Complex> column(n);
  for (std::size_t i = 0; i < n; ++i) column[i] = table_[i][0];
  coefficients_ = {column[0]};
  for (std::size_t order = 1; order < n; ++order) {
    for (std::size_t i = 0; i + order < n; ++i) {
      column[i] = x_[i + order] == x_[i] ? table_[i][static_cast<Eigen::Index>(order)]
                                         : (column[i + 1] - column[i]) / (x_[i + order] - x_[i]);
    }
    coefficients_.push_back(column[0]);
  }
}

Complex ComplexInterpolant::operator()(Complex x) const {
  Complex value = 0.0;
  for (std::size_t i = coefficients_.size(); i-- > 0;) value = value * (x - x_[i]) + coefficients_[i];
  return value;
}

double ComplexInterpolant::last_contribution(Complex x) const {
  double product = 1.0;
  double last = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    before = last;
    last = product * std::abs(coefficients_[i]);
    product *= std::abs(x - x_[i]);
  }
  return std::max(last, before);
}

Complex ComplexInterpolant::root_near(Complex root, double width) const {
  constexpr int most_secants = 30;  // about ten suffice near a simple root
  // Shares of the width: distance of the second starting point of the first secant, small against the scale
  // of the function and large against rounding; and the move that ends the iteration, at the level of
  // rounding.
  constexpr double first = 1e-3;
  constexpr double settled = 1e-15;
  Complex a = root + first * width;
  Complex at_a = (*this)(a);
  for (int i = 0; i < most_secants; ++i) {
    const Complex here = (*this)(root);
    if (here == at_a) break;
    const Complex next = root - here * (root - a) / (here - at_a);
    a = root;
    at_a = here;
    root = next;
    if (std::abs(root - a) <= settled * width) break;
  }
  return root;
}

double ComplexInterpolant::error_of_root(Complex root, double width) const {
  const double slope = std::abs((*this)(root + width) - (*this)(root - width)) / (2.0 * width);
  return slope > 0.0 ? last_contribution(root) / slope : INFINITY;
}

bool ComplexInterpolant::is_double_root(Complex root, double trusted_share) const {
  // Share of the distance from the axis: step of the central differences. Their truncation error is about a
  // hundredth, which is below the share that decides.
  constexpr double difference_step = 0.1;
  const double step = difference_step * std::abs(root.imag());
  const Complex ahead = (*this)(root + step);
  const Complex back = (*this)(root - step);
  const Complex slope = (ahead - back) / (2.0 * step);
  const Complex curvature = (ahead + back - 2.0 * (*this)(root)) / (step * step);
  return std::abs(slope) <= trusted_share * std::abs(curvature * root.imag());
}

}  // namespace eigentrail
