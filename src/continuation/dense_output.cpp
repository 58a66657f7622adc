#include "eigentrail/continuation/dense_output.hpp"

#include <algorithm>
#include <cmath>

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

HermiteInterpolant::HermiteInterpolant(double a, const ComplexMatrix& left, double b,
                                       const ComplexMatrix& right)
    : begin_(a), length_(b - a), at_left_(left.rows(), left.cols()), slope_(left.rows(), left.cols()) {
  const ComplexMatrix l = in_unit_length(left, length_);
  const ComplexMatrix r = in_unit_length(right, length_);
  const Eigen::Index nodes = left.cols();  // at each end
  // Row by row in the number of left nodes i: F(i, j) = F(i-1, j) - F(i, j-1), the ends lying 1 apart in t.
  std::vector<ComplexVector> above;  // F(i-1, j) by j
  above.emplace_back();
  for (Eigen::Index j = 1; j <= nodes; ++j) above.emplace_back(r.col(j - 1));
  for (Eigen::Index i = 1; i <= nodes; ++i) {
    std::vector<ComplexVector> row{l.col(i - 1)};
    for (Eigen::Index j = 1; j <= nodes; ++j) {
      row.emplace_back(above[static_cast<std::size_t>(j)] - row[static_cast<std::size_t>(j - 1)]);
    }
    at_left_.col(i - 1) = row[static_cast<std::size_t>(i - 1)];
    slope_.col(i - 1) = row[static_cast<std::size_t>(i)];
    above = std::move(row);
  }
}

ComplexVector HermiteInterpolant::operator()(double p) const {
  const double t = (p - begin_) / length_;
  const double bubble = t * (t - 1.0);
  ComplexVector value = ComplexVector::Zero(at_left_.rows());
  for (Eigen::Index k = at_left_.cols() - 1; k >= 0; --k)
    value = value * bubble + at_left_.col(k) + slope_.col(k) * t;
  return value;
}

double HermiteInterpolant::term(Eigen::Index function, Eigen::Index k) const {
  return std::max(std::abs(at_left_(function, k)), std::abs(at_left_(function, k) + slope_(function, k)));
}

Vector HermiteInterpolant::estimated_error() const {
  const Eigen::Index q = at_left_.cols() - 1;
  Vector error = Vector::Zero(at_left_.rows());
  if (q < 2) return error;
  const double bubble = std::pow(0.25, static_cast<double>(q + 1));  // largest |t (t - 1)|^(q+1)
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double last = term(i, q);
    const double before = term(i, q - 1);
    double next = before > 0.0 ? last * (last / before) : last;
    // The last term may vanish by chance; the two before it tell the decay as well.
    if (q >= 3 && term(i, q - 2) > 0.0) {
      const double decay = before / term(i, q - 2);
      next = std::max(next, before * decay * decay);
    }
    error[i] = bubble * next;
  }
  return error;
}

}  // namespace eigentrail
