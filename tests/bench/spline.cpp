#include "bench/spline.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace eigentrail::test {

CubicSpline::CubicSpline(ComplexMatrix values) : values_(std::move(values)), slopes_(values_) {
  const Eigen::Index n = values_.rows();
  if (n < 4) throw std::invalid_argument("CubicSpline: expected four nodes, got " + std::to_string(n));
  const auto end_slope = [&](Eigen::Index at, Eigen::Index to) {
    return ((-11.0 * values_.row(at) + 18.0 * values_.row(at + to) - 9.0 * values_.row(at + 2 * to) +
             2.0 * values_.row(at + 3 * to)) *
            (static_cast<double>(to) / 6.0))
        .eval();
  };
  slopes_.row(0) = end_slope(0, 1);
  slopes_.row(n - 1) = end_slope(n - 1, -1);
  // m[i-1] + 4 m[i] + m[i+1] = 3 (y[i+1] - y[i-1]), by elimination downwards.
  std::vector<double> factor(static_cast<std::size_t>(n), 0.0);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const double pivot = 4.0 - factor[static_cast<std::size_t>(i) - 1];
    factor[static_cast<std::size_t>(i)] = 1.0 / pivot;
    slopes_.row(i) = (3.0 * (values_.row(i + 1) - values_.row(i - 1)) - slopes_.row(i - 1)) / pivot;
  }
  for (Eigen::Index i = n - 2; i > 0; --i)
    slopes_.row(i) -= factor[static_cast<std::size_t>(i)] * slopes_.row(i + 1);
}

ComplexVector CubicSpline::operator()(double t) const {
  const auto i = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(t), 0, values_.rows() - 2);
  const double u = t - static_cast<double>(i);
  const double v = 1.0 - u;
  return (v * v * (1.0 + 2.0 * u) * values_.row(i) + u * u * (1.0 + 2.0 * v) * values_.row(i + 1) +
          u * v * (v * slopes_.row(i) - u * slopes_.row(i + 1)))
      .transpose();
}

}  // namespace eigentrail::test
