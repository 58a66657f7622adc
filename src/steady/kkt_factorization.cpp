#include "eigentrail/steady/kkt_factorization.hpp"

namespace eigentrail {
namespace {

constexpr double singular = 1e-14;

}  // namespace

KktFactorization::KktFactorization(const Matrix& K, const Matrix& A) : K_(K), constraints_(A) {
  const Matrix& Q2 = constraints_.null_basis();
  if (Q2.cols() == 0) return;
  const Matrix tangent = Q2.transpose() * K * Q2;
  tangent_.compute(tangent);
  reciprocal_condition_ = tangent.isZero(0.0) ? 0.0 : tangent_.rcond();
  if (!(reciprocal_condition_ > singular)) {
    singular_tangent_.setThreshold(singular);
    singular_tangent_.compute(tangent);
  }
}

void KktFactorization::solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const {
  const Matrix& Q2 = constraints_.null_basis();
  dx = constraints_.pseudo_inverse_times(g);
  if (Q2.cols() > 0) {
    const Vector tangential = Q2.transpose() * (r - K_ * dx);
    const bool regular = reciprocal_condition_ > singular;
    dx += Q2 * (regular ? tangent_.solve(tangential).eval() : singular_tangent_.solve(tangential).eval());
  }
  dl = constraints_.transposed_pseudo_inverse_times(r - K_ * dx);
}

}  // namespace eigentrail
