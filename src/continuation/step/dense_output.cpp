#include "eigentrail/continuation/dense_output.hpp"

#include <algorithm>
#include <cmath>

namespace eigentrail {
namespace {

/// Largest ratio of successive terms that the error estimate uses; larger ratios are replaced by it. The sum
/// of the terms after the last one is at most 4 times the last one then. A larger value makes estimates
/// larger where the terms hardly decrease.
constexpr double slowest_decay = 0.8;

}  // namespace

HermiteInterpolant::HermiteInterpolant(double length, const ComplexMatrix& left, const ComplexMatrix& right)
    : left_value_(left.rows(), left.cols()),
      right_value_(left.rows(), left.cols()),
      slope_(left.rows(), left.cols()) {
  const Eigen::Index nodes = left.cols();  // at each end
  // Coefficients with respect to t: coefficient k times length^k.
  ComplexMatrix table(left.rows(), nodes + 1);  // F(i, j) in column j, row by row in i
  double power = 1.0;
  for (Eigen::Index j = 1; j <= nodes; ++j, power *= length) table.col(j) = right.col(j - 1) * power;
  right_value_.col(0) = table.col(1);
  power = 1.0;
  for (Eigen::Index i = 1; i <= nodes; ++i, power *= length) {
    // F(i, j) = F(i-1, j) - F(i, j-1), because the ends are 1 apart in t.
    table.col(0) = left.col(i - 1) * power;
    for (Eigen::Index j = 1; j <= nodes; ++j) table.col(j) -= table.col(j - 1);
    left_value_.col(i - 1) = table.col(i - 1);
    slope_.col(i - 1) = table.col(i);
    if (i < nodes) right_value_.col(i) = table.col(i + 1);
  }
}

template <class Scalar>
ComplexVector HermiteInterpolant::evaluate(Scalar t) const {
  const bool left = std::real(t) <= 0.5;
  const ComplexMatrix& values = near_values(left);
  const Scalar u = left ? t : 1.0 - t;
  const Scalar along = left ? u : -u;  // seen from the right end the slopes have the opposite sign
  const Scalar bubble = u * (u - 1.0);
  ComplexVector value = ComplexVector::Zero(size());
  for (Eigen::Index k = slope_.cols() - 1; k >= 0; --k)
    value = value * bubble + values.col(k) + slope_.col(k) * along;
  return value;
}

ComplexVector HermiteInterpolant::operator()(double t) const {
  return evaluate(t);
}

ComplexVector HermiteInterpolant::operator()(Complex t) const {
  return evaluate(t);
}

ComplexVector HermiteInterpolant::slope(double t) const {
  return series(t, 1).col(1);
}

ComplexMatrix HermiteInterpolant::series(double t0, int order) const {
  const bool left = t0 <= 0.5;
  const ComplexMatrix& values = near_values(left);
  const double u = left ? t0 : 1.0 - t0;
  const double du = left ? 1.0 : -1.0;
  // The Horner scheme of `operator()` with polynomials in x = t - t0: `bubble` holds the coefficients of
  // (u + du x) (u + du x - 1), the factor between successive terms.
  const double bubble[] = {u * (u - 1.0), du * (2.0 * u - 1.0), 1.0};
  ComplexMatrix value = ComplexMatrix::Zero(size(), order + 1);
  for (Eigen::Index k = slope_.cols() - 1; k >= 0; --k) {
    for (Eigen::Index j = order; j >= 0; --j) {
      value.col(j) *= bubble[0];
      if (j > 0) value.col(j) += bubble[1] * value.col(j - 1);
      if (j > 1) value.col(j) += bubble[2] * value.col(j - 2);
    }
    value.col(0) += values.col(k) + slope_.col(k) * (du * u);
    if (order > 0) value.col(1) += slope_.col(k);
  }
  return value;
}

double HermiteInterpolant::term(Eigen::Index function, Eigen::Index k) const {
  const double size =
      std::max(std::abs(left_value_(function, k)), std::abs(left_value_(function, k) + slope_(function, k)));
  return size * std::pow(0.25, static_cast<double>(k));  // the largest |t (t - 1)|^k
}

double HermiteInterpolant::last_share(Eigen::Index function, Complex t) const {
  const bool left = t.real() <= 0.5;
  const ComplexMatrix& values = near_values(left);
  const Complex u = left ? t : 1.0 - t;
  const Complex along = left ? u : -u;
  double power = 1.0;
  double last = 0.0;
  double largest = 0.0;
  for (Eigen::Index k = 0; k < slope_.cols(); ++k, power *= std::abs(u * (u - 1.0))) {
    last = power * std::abs(values(function, k) + slope_(function, k) * along);
    largest = std::max(largest, last);
  }
  return largest > 0.0 ? last / largest : 0.0;
}

Vector HermiteInterpolant::error_without_last() const {
  const Eigen::Index q = slope_.cols() - 1;
  Vector error(size());
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double last = term(i, q);
    const double before = term(i, q - 1);
    const double decay = before > 0.0 ? std::min(last / before, slowest_decay) : slowest_decay;
    error[i] = last / (1.0 - decay);
  }
  return error;
}

}  // namespace eigentrail
