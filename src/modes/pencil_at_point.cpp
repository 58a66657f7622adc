#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {
namespace {

/// As real matrix-vector products: a matrix product would first copy B into its own order, which costs more
/// than the few columns themselves.
template <class Real>
ComplexMatrix multiply_columns(const Real& B, const ComplexMatrix& Z) {
  ComplexMatrix result(B.rows(), Z.cols());
  Vector part(Z.rows()), product(B.rows());
  for (Eigen::Index j = 0; j < Z.cols(); ++j) {
    part = Z.col(j).real();
    product.noalias() = B * part;
    result.col(j).real() = product;
    part = Z.col(j).imag();
    product.noalias() = B * part;
    result.col(j).imag() = product;
  }
  return result;
}

}  // namespace

ComplexMatrix multiply(const Matrix& B, const ComplexMatrix& Z) {
  return multiply_columns(B, Z);
}

ComplexMatrix multiply(const SystemMatrix& B, const ComplexMatrix& Z) {
  return B.visit([&](const auto& values) { return multiply_columns(values, Z); });
}

PencilAtPoint::PencilAtPoint(const ReducedPencil& pencil, Chart chart)
    : M(chart == Chart::finite ? pencil.M[0] : pencil.K[0]),
      C(pencil.C[0]),
      K(chart == Chart::finite ? pencil.K[0] : pencil.M[0]),
      norm_M(M.norm()),
      norm_C(C.norm()),
      norm_K(K.norm()) {}

ComplexMatrix PencilAtPoint::matrix(Complex mu) const {
  ComplexMatrix P(M.rows(), M.cols());
  const Complex mu2 = mu * mu;
  P.real() = mu2.real() * M + mu.real() * C + K;
  P.imag() = mu2.imag() * M + mu.imag() * C;
  return P;
}

ComplexMatrix PencilAtPoint::residual(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const {
  ComplexMatrix slope = multiply(M, Z);
  if (Z.cols() == 1) {
    slope *= Lambda(0, 0);
    if (!is_undamped()) slope += multiply(C, Z);
    return slope * Lambda(0, 0) + multiply(K, Z);
  }
  return (slope * Lambda + multiply(C, Z)) * Lambda + multiply(K, Z);
}

double PencilAtPoint::magnitude(double mu) const {
  return (mu * norm_M + norm_C) * mu + norm_K;
}

}  // namespace eigentrail
