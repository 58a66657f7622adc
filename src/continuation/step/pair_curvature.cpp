#include "continuation/step/pair_curvature.hpp"

namespace eigentrail {

PairCurvature::PairCurvature(const PairAtPlace& at, const ComplexMatrix& W1, double scale, Eigen::Index i,
                             Eigen::Index j)
    : at_(at), W1_(W1), scale_(scale), E_(ComplexMatrix::Zero(at.Lambda.rows(), at.Lambda.cols())) {
  E_(i, j) = scale;
  EL_ = E_ * at.Lambda + at.Lambda * E_;
}

ComplexVector PairCurvature::times(const ComplexVector& v) const {
  const Eigen::Index n = at_.Z.rows();
  const Eigen::Index k = at_.Z.cols();
  const ComplexMatrix X = v.head(n * k).reshaped(n, k);
  const ComplexMatrix L = scale_ * v.tail(k * k).reshaped(k, k);
  const ComplexMatrix R = multiply(at_.pencil.M, at_.pencil.bands.M, X).lazyProduct(EL_) +
                          multiply(at_.pencil.C, at_.pencil.bands.C, X).lazyProduct(E_) +
                          at_.MZ.lazyProduct(0.5 * (L * E_ + E_ * L));
  const ComplexMatrix N = (W1_.adjoint() * X) * E_;
  ComplexVector result(v.size());
  result << R.reshaped(), N.reshaped();
  return result;
}

ComplexVector PairCurvature::adjoint_times(const ComplexVector& v) const {
  const Eigen::Index n = at_.Z.rows();
  const Eigen::Index k = at_.Z.cols();
  const ComplexMatrix R = v.head(n * k).reshaped(n, k);
  const ComplexMatrix N = v.tail(k * k).reshaped(k, k);
  const ComplexMatrix X =
      transposed_multiply(at_.pencil.M, at_.pencil.bands.M, R.lazyProduct(EL_.adjoint())) +
      transposed_multiply(at_.pencil.C, at_.pencil.bands.C, R.lazyProduct(E_.adjoint())) +
      W1_.lazyProduct(N * E_.adjoint());
  const ComplexMatrix of_R = 0.5 * (at_.MZ.adjoint() * R);
  const ComplexMatrix L = scale_ * (of_R * E_.adjoint() + E_.adjoint() * of_R);
  ComplexVector result(v.size());
  result << X.reshaped(), L.reshaped();
  return result;
}

}  // namespace eigentrail
