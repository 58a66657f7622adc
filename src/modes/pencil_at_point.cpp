#include "eigentrail/modes/pencil_at_point.hpp"

#include <utility>

#include "core/band_matrix.hpp"
#include "core/products.hpp"
#include "modes/companion_form.hpp"

namespace eigentrail {
namespace {

constexpr Eigen::Index large = 16;  ///< number of rows from which BLAS is faster, its call included

/// Real matrix-vector products per column: Eigen's matrix product would first copy B into packed form, which
/// takes longer than the product with few columns.
template <class Real>
ComplexMatrix multiply_columns(const Real& B, const ComplexMatrix& Z) {
  ComplexMatrix result(B.rows(), Z.cols());
  Vector part(Z.rows()), Bz(B.rows());
  for (Eigen::Index j = 0; j < Z.cols(); ++j) {
    part = Z.col(j).real();
    Bz.noalias() = B * part;
    result.col(j).real() = Bz;
    part = Z.col(j).imag();
    Bz.noalias() = B * part;
    result.col(j).imag() = Bz;
  }
  return result;
}

}  // namespace

ComplexMatrix multiply(const Matrix& B, const ComplexMatrix& Z) {
  if (B.isDiagonal(0.0)) return B.diagonal().asDiagonal() * Z;
  return B.rows() < large ? multiply_columns(B, Z) : product(B, Z);
}

ComplexMatrix multiply(const SparseMatrix& B, const ComplexMatrix& Z) {
  return multiply_columns(B, Z);
}

ComplexMatrix multiply(const SystemMatrix& B, const ComplexMatrix& Z) {
  return B.visit([&](const auto& values) { return multiply(values, Z); });
}

ComplexMatrix transposed_multiply(const Matrix& B, const ComplexMatrix& Z) {
  return B.rows() < large ? multiply_columns(B.transpose(), Z) : transposed_product(B, Z);
}

Eigen::Index state_size(const Matrix& M) {
  return M.cols() + static_cast<Eigen::Index>(coordinates_with_mass(M).size());
}

Matrix leading_matrix(const Matrix& M, const Matrix& C, double per_mass) {
  Matrix leading = per_mass * M;
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    if (M.col(j).isZero(0.0)) leading.col(j) = C.col(j);
  }
  return leading;
}

ComplexMatrix multiply(const Matrix& B, const std::shared_ptr<const Matrix>& band, const ComplexMatrix& Z) {
  return band ? band_product(*band, Z) : multiply(B, Z);
}

ComplexMatrix transposed_multiply(const Matrix& B, const std::shared_ptr<const Matrix>& band,
                                  const ComplexMatrix& Z) {
  return band ? transposed_band_product(*band, Z) : transposed_multiply(B, Z);
}

PencilAtPoint::PencilAtPoint(const ReducedPencil& pencil, Chart chart)
    : M(chart == Chart::finite ? pencil.M[0] : pencil.K[0]),
      C(pencil.C[0]),
      K(chart == Chart::finite ? pencil.K[0] : pencil.M[0]),
      norm_M(M.norm()),
      norm_C(C.norm()),
      norm_K(K.norm()),
      complex_sign(pencil.complex_sign) {}

PencilAtPoint::PencilAtPoint(const PencilAtPoint& finite, Chart chart)
    : M(chart == Chart::finite ? finite.M : finite.K),
      C(finite.C),
      K(chart == Chart::finite ? finite.K : finite.M),
      norm_M(chart == Chart::finite ? finite.norm_M : finite.norm_K),
      norm_C(finite.norm_C),
      norm_K(chart == Chart::finite ? finite.norm_K : finite.norm_M),
      complex_sign(finite.complex_sign),
      bands(finite.bands) {
  if (chart == Chart::reciprocal) std::swap(bands.M, bands.K);
}

ComplexMatrix PencilBands::sum(Complex a, Complex b, double c) const {
  ComplexMatrix sum(M->rows(), M->cols());
  sum.real() = a.real() * *M + b.real() * *C + c * *K;
  sum.imag() = a.imag() * *M + b.imag() * *C;
  return sum;
}

ComplexMatrix PencilAtPoint::matrix(Complex mu) const {
  ComplexMatrix P(M.rows(), M.cols());
  const Complex mu2 = mu * mu;
  // Entry by entry: assignments to real and imaginary part apart go twice through the memory.
  for (Eigen::Index i = 0; i < P.size(); ++i) {
    const double m = M.data()[i];
    const double c = C.data()[i];
    P.data()[i] = {mu2.real() * m + mu.real() * c + K.data()[i], mu2.imag() * m + mu.imag() * c};
  }
  return P;
}

ComplexMatrix PencilAtPoint::residual(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const {
  // Lazy products, because there are few columns.
  ComplexMatrix slope = multiply(M, Z).lazyProduct(Lambda);
  if (!is_undamped()) slope += multiply(C, Z);
  return slope.lazyProduct(Lambda) + multiply(K, Z);
}

Vector PencilAtPoint::terms(const ComplexMatrix& Z, const ComplexMatrix& Lambda) const {
  const auto magnitudes = [](const Matrix& B, const std::shared_ptr<const Matrix>& band, const Matrix& X) {
    const ComplexMatrix columns = X.cast<Complex>();
    return Matrix(
        (band ? band_product(band->cwiseAbs(), columns) : multiply(Matrix(B.cwiseAbs()), columns)).real());
  };
  const Matrix values = Z.cwiseAbs();
  const Matrix once = values.lazyProduct(Lambda.cwiseAbs());
  Matrix sum = magnitudes(K, bands.K, values) + magnitudes(M, bands.M, once.lazyProduct(Lambda.cwiseAbs()));
  if (!is_undamped()) sum += magnitudes(C, bands.C, once);
  return sum.rowwise().norm();
}

double PencilAtPoint::magnitude(double mu) const {
  return (mu * norm_M + norm_C) * mu + norm_K;
}

}  // namespace eigentrail
