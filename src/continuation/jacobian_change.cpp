#include "continuation/jacobian_change.hpp"

#include "core/products.hpp"

namespace eigentrail {
namespace {

ComplexMatrix slope_of(const PairAtPlace& place, const ComplexMatrix& MZ) {
  return MZ.lazyProduct(place.Lambda) + multiply(place.pencil.C, place.Z);
}

}  // namespace

JacobianChange::JacobianChange(const PairAtPlace& from, const PairAtPlace& to, const ComplexMatrix& W1,
                               double scale)
    : from_(from),
      to_(to),
      W1_(W1),
      scale_(scale),
      MZ_from_(multiply(from.pencil.M, from.Z)),
      MZ_to_(multiply(to.pencil.M, to.Z)),
      Z_(to.Z - from.Z),
      Lambda_(to.Lambda - from.Lambda),
      slope_(slope_of(to, MZ_to_) - slope_of(from, MZ_from_)) {
  if (Z_.cols() == 1) {
    set_pencil();
    return;
  }
  add_terms(from.pencil.M, from.Lambda * from.Lambda, to.pencil.M, to.Lambda * to.Lambda);
  add_terms(from.pencil.C, from.Lambda, to.pencil.C, to.Lambda);
  K_ = to.pencil.K - from.pencil.K;
}

void JacobianChange::set_pencil() {
  const PencilAtPoint& a = from_.pencil;
  const PencilAtPoint& b = to_.pencil;
  const Complex s_a = from_.Lambda(0, 0);
  const Complex s_b = to_.Lambda(0, 0);
  const Complex square_a = s_a * s_a;
  const Complex square_b = s_b * s_b;
  P_.resize(Z_.rows(), Z_.rows());
  P_.real() = square_b.real() * b.M - square_a.real() * a.M + s_b.real() * b.C - s_a.real() * a.C + b.K - a.K;
  P_.imag() = square_b.imag() * b.M - square_a.imag() * a.M + s_b.imag() * b.C - s_a.imag() * a.C;
}

void JacobianChange::add_terms(const Matrix& from, const ComplexMatrix& L_from, const Matrix& to,
                               const ComplexMatrix& L_to) {
  if (from == to) {
    terms_.push_back({&to, L_to - L_from});
    return;
  }
  terms_.push_back({&to, L_to});
  terms_.push_back({&from, -L_from});
}

ComplexVector JacobianChange::times(const ComplexVector& v) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  const ComplexMatrix X = v.head(n * k).reshaped(n, k);
  const ComplexMatrix Y = scale_ * v.tail(k * k).reshaped(k, k);
  ComplexMatrix R =
      MZ_to_.lazyProduct(Y * to_.Lambda) - MZ_from_.lazyProduct(Y * from_.Lambda) + slope_.lazyProduct(Y);
  ComplexMatrix N = ComplexMatrix::Zero(k, k);
  if (k == 1) {  // W1 = 0
    R += product(P_, ComplexVector(X));
  } else {
    R += multiply(K_, X);
    for (const Term& term : terms_) R += multiply(*term.B, X).lazyProduct(term.L);
    N = W1_.adjoint() * (X.lazyProduct(Lambda_) + Z_.lazyProduct(Y));
  }
  ComplexVector result(v.size());
  result << R.reshaped(), N.reshaped();
  return result;
}

ComplexVector JacobianChange::adjoint_times(const ComplexVector& v) const {
  const Eigen::Index n = Z_.rows();
  const Eigen::Index k = Z_.cols();
  const ComplexMatrix R = v.head(n * k).reshaped(n, k);
  ComplexMatrix Y = (MZ_to_.adjoint() * R) * to_.Lambda.adjoint() -
                    (MZ_from_.adjoint() * R) * from_.Lambda.adjoint() + slope_.adjoint() * R;
  ComplexMatrix X;
  if (k == 1) {
    X = adjoint_product(P_, ComplexVector(R));
  } else {
    const ComplexMatrix W1N = W1_.lazyProduct(v.tail(k * k).reshaped(k, k));
    X = transposed_multiply(K_, R) + W1N.lazyProduct(Lambda_.adjoint());
    for (const Term& term : terms_) X += transposed_multiply(*term.B, R).lazyProduct(term.L.adjoint());
    Y += Z_.adjoint() * W1N;
  }
  ComplexVector result(v.size());
  result << X.reshaped(), scale_ * Y.reshaped();
  return result;
}

}  // namespace eigentrail
