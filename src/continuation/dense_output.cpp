#include "eigentrail/continuation/dense_output.hpp"

namespace eigentrail {
namespace {

/// Series coefficients in the unit of t: column k times length^k.
ComplexMatrix in_unit_length(const ComplexMatrix& series, double length) {
  ComplexMatrix scaled = series;
  double power = 1.0;
  for (Eigen::Index k = 0; k < scaled.cols(); ++k, power *= length) scaled.col(k) *= power;
  return scaled;
}

}  // namespace

HermiteInterpolant::HermiteInterpolant(double a, const ComplexMatrix& left, double b, const ComplexMatrix& right)
    : begin_(a), length_(b - a), repeated_(left.cols()) {
  const ComplexMatrix l = in_unit_length(left, length_);
  const ComplexMatrix r = in_unit_length(right, length_);
  const Eigen::Index q1 = repeated_;
  // Divided differences over the nodes 0 (q1 times), 1 (q1 times). row(i) holds the difference of the current level
  // that begins at node i; between equal nodes it is a series coefficient.
  std::vector<ComplexVector> level;
  for (Eigen::Index i = 0; i < 2 * q1; ++i) level.emplace_back(i < q1 ? l.col(0) : r.col(0));
  difference_.resize(left.rows(), 2 * q1);
  difference_.col(0) = level[0];
  for (Eigen::Index k = 1; k < 2 * q1; ++k) {
    for (Eigen::Index i = 0; i + k < 2 * q1; ++i) {
      const bool both_left = i + k < q1;
      const bool both_right = i >= q1;
      const auto at = static_cast<std::size_t>(i);
      if (both_left) {
        level[at] = l.col(k);
      } else if (both_right) {
        level[at] = r.col(k);
      } else {
        level[at] = (level[at + 1] - level[at]).eval();  // the nodes lie 1 apart in t
      }
    }
    difference_.col(k) = level[0];
  }
}

ComplexVector HermiteInterpolant::operator()(double p) const {
  const double t = (p - begin_) / length_;
  Eigen::Index k = difference_.cols() - 1;
  ComplexVector value = difference_.col(k);
  while (k-- > 0) value = value * (k < repeated_ ? t : t - 1.0) + difference_.col(k);
  return value;
}

}  // namespace eigentrail
