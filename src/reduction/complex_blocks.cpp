#include "eigentrail/reduction/complex_blocks.hpp"

#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

Complex unit_of(int complex_sign) {
  return {0.0, static_cast<double>(complex_sign)};
}

/// 1 / sqrt(2): lengths are kept.
constexpr double inverse_root = 0.5 * std::numbers::sqrt2;

template <class Values>
ComplexMatrix block_in(const Values& canonical, int complex_sign) {
  const Eigen::Index m = canonical.rows() / 2;
  return canonical.topLeftCorner(m, m) +
         unit_of(complex_sign) * canonical.bottomLeftCorner(m, m).template cast<Complex>();
}

}  // namespace

ComplexMatrix complex_coordinates(const ComplexMatrix& Z, int complex_sign) {
  const Eigen::Index m = Z.rows() / 2;
  return inverse_root * (Z.topRows(m) + unit_of(complex_sign) * Z.bottomRows(m));
}

ComplexMatrix from_complex_coordinates(const ComplexMatrix& q, int complex_sign) {
  ComplexMatrix Z(2 * q.rows(), q.cols());
  Z.topRows(q.rows()) = inverse_root * q;
  Z.bottomRows(q.rows()) = (-inverse_root * unit_of(complex_sign)) * q;
  return Z;
}

ComplexMatrix complex_block(const Matrix& canonical, int complex_sign) {
  return block_in(canonical, complex_sign);
}

ComplexMatrix complex_block(const ComplexMatrix& canonical, int complex_sign) {
  return block_in(canonical, complex_sign);
}

Matrix canonical_form(const Matrix& matrix) {
  const Eigen::Index m = matrix.rows() / 2;
  const Matrix A = 0.5 * (matrix.topLeftCorner(m, m) + matrix.bottomRightCorner(m, m));
  const Matrix B = 0.5 * (matrix.bottomLeftCorner(m, m) - matrix.topRightCorner(m, m));
  Matrix result(2 * m, 2 * m);
  result << A, -B, B, A;
  return result;
}

}  // namespace eigentrail
