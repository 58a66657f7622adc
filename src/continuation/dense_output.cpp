#include "eigentrail/continuation/dense_output.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace eigentrail {
namespace {

/// Terms that fall more slowly than this are taken to fall like this.
constexpr double slowest_decay = 0.8;

/// Series coefficients in the unit of t: column k times length^k.
ComplexMatrix in_unit_length(const ComplexMatrix& series, double length) {
  ComplexMatrix scaled = series;
  double power = 1.0;
  for (Eigen::Index k = 0; k < scaled.cols(); ++k, power *= length) scaled.col(k) *= power;
  return scaled;
}

}  // namespace

HermiteInterpolant::HermiteInterpolant(double length, const ComplexMatrix& left, const ComplexMatrix& right)
    : from_left_(length, left, right), from_right_(-length, right, left) {}

HermiteInterpolant::Terms::Terms(double length, const ComplexMatrix& near, const ComplexMatrix& far)
    : value(near.rows(), near.cols()), slope(near.rows(), near.cols()) {
  const ComplexMatrix l = in_unit_length(near, length);
  const ComplexMatrix r = in_unit_length(far, length);
  const Eigen::Index nodes = near.cols();  // at each end
  // Row by row in the number of near nodes i: F(i, j) = F(i-1, j) - F(i, j-1), the ends lying 1 apart in t.
  std::vector<ComplexVector> above;  // F(i-1, j) by j
  above.emplace_back();
  for (Eigen::Index j = 1; j <= nodes; ++j) above.emplace_back(r.col(j - 1));
  for (Eigen::Index i = 1; i <= nodes; ++i) {
    std::vector<ComplexVector> row{l.col(i - 1)};
    for (Eigen::Index j = 1; j <= nodes; ++j) {
      row.emplace_back(above[static_cast<std::size_t>(j)] - row[static_cast<std::size_t>(j - 1)]);
    }
    value.col(i - 1) = row[static_cast<std::size_t>(i - 1)];
    slope.col(i - 1) = row[static_cast<std::size_t>(i)];
    above = std::move(row);
  }
}

ComplexVector HermiteInterpolant::operator()(Complex t) const {
  const bool left = t.real() <= 0.5;
  const Terms& terms = left ? from_left_ : from_right_;
  const Complex u = left ? t : 1.0 - t;
  const Complex bubble = u * (u - 1.0);
  ComplexVector value = ComplexVector::Zero(terms.value.rows());
  for (Eigen::Index k = terms.value.cols() - 1; k >= 0; --k)
    value = value * bubble + terms.value.col(k) + terms.slope.col(k) * u;
  return value;
}

ComplexVector HermiteInterpolant::slope(double t) const {
  const bool left = t <= 0.5;
  const Terms& terms = left ? from_left_ : from_right_;
  const double u = left ? t : 1.0 - t;
  const double bubble = u * (u - 1.0);
  ComplexVector value = ComplexVector::Zero(terms.value.rows());
  ComplexVector derivative = value;
  for (Eigen::Index k = terms.value.cols() - 1; k >= 0; --k) {
    derivative = derivative * bubble + value * (2.0 * u - 1.0) + terms.slope.col(k);
    value = value * bubble + terms.value.col(k) + terms.slope.col(k) * u;
  }
  return left ? derivative : ComplexVector(-derivative);
}

ComplexMatrix HermiteInterpolant::series(double t0, int order) const {
  const bool left = t0 <= 0.5;
  const Terms& terms = left ? from_left_ : from_right_;
  const double u = left ? t0 : 1.0 - t0;
  const double du = left ? 1.0 : -1.0;
  // (u + du x) (u + du x - 1) and u + du x as polynomials in x multiply the Horner scheme of `operator()`.
  const double bubble[] = {u * (u - 1.0), du * (2.0 * u - 1.0), 1.0};
  ComplexMatrix value = ComplexMatrix::Zero(terms.value.rows(), order + 1);
  for (Eigen::Index k = terms.value.cols() - 1; k >= 0; --k) {
    for (Eigen::Index j = order; j >= 0; --j) {
      value.col(j) *= bubble[0];
      if (j > 0) value.col(j) += bubble[1] * value.col(j - 1);
      if (j > 1) value.col(j) += bubble[2] * value.col(j - 2);
    }
    value.col(0) += terms.value.col(k) + terms.slope.col(k) * u;
    if (order > 0) value.col(1) += terms.slope.col(k) * du;
  }
  return value;
}

double HermiteInterpolant::term(Eigen::Index function, Eigen::Index k) const {
  const double size = std::max(std::abs(from_left_.value(function, k)),
                               std::abs(from_left_.value(function, k) + from_left_.slope(function, k)));
  return size * std::pow(0.25, static_cast<double>(k));  // the largest |t (t - 1)|^k
}

double HermiteInterpolant::last_share(Eigen::Index function, Complex t) const {
  const bool left = t.real() <= 0.5;
  const Terms& terms = left ? from_left_ : from_right_;
  const Complex u = left ? t : 1.0 - t;
  double power = 1.0;
  double last = 0.0;
  double largest = 0.0;
  for (Eigen::Index k = 0; k < terms.value.cols(); ++k, power *= std::abs(u * (u - 1.0))) {
    last = power * std::abs(terms.value(function, k) + terms.slope(function, k) * u);
    largest = std::max(largest, last);
  }
  return largest > 0.0 ? last / largest : 0.0;
}

Vector HermiteInterpolant::error_without_last() const {
  const Eigen::Index q = from_left_.value.cols() - 1;
  Vector error(from_left_.value.rows());
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double last = term(i, q);
    const double before = term(i, q - 1);
    const double decay = before > 0.0 ? std::min(last / before, slowest_decay) : slowest_decay;
    error[i] = last / (1.0 - decay);
  }
  return error;
}

}  // namespace eigentrail
