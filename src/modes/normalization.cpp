#include "eigentrail/modes/normalization.hpp"

#include <cmath>

#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

double mass_norm_squared(const ComplexVector& v, const SystemMatrix& M) {
  const double square = v.dot(multiply(M, v).col(0)).real();
  return square > 1e-12 * M.norm() * v.squaredNorm() ? square : 0.0;
}

ComplexVector normalize_shape(const ComplexVector& v, const SystemMatrix& M, const ComplexVector& reference) {
  ComplexVector Mv = multiply(M, v);
  double square = mass_norm_squared(v, M);
  if (square == 0.0) {
    Mv = v;
    square = v.squaredNorm();
  }
  // The reference has unit norm, so |anchor| lies between 0 and sqrt(square). Below 1e-8 of that v counts as
  // orthogonal to it.
  Complex anchor = reference.size() == v.size() ? reference.dot(Mv) : Complex(0.0);
  if (std::abs(anchor) <= 1e-8 * std::sqrt(square)) {
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    anchor = v[largest];
  }
  return v * (std::abs(anchor) / anchor / std::sqrt(square));
}

}  // namespace eigentrail
