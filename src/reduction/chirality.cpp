#include "eigentrail/reduction/chirality.hpp"

#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

Complex unit_of(int chirality) {
  return {0.0, static_cast<double>(chirality)};
}

/// 1 / sqrt(2): lengths are kept.
constexpr double inverse_root = 0.5 * std::numbers::sqrt2;

template <class Values>
ComplexMatrix block_in(const Values& canonical, int chirality) {
  const Eigen::Index m = canonical.rows() / 2;
  return canonical.topLeftCorner(m, m) +
         unit_of(chirality) * canonical.bottomLeftCorner(m, m).template cast<Complex>();
}

}  // namespace

ComplexMatrix chiral_coordinates(const ComplexMatrix& Z, int chirality) {
  const Eigen::Index m = Z.rows() / 2;
  return inverse_root * (Z.topRows(m) + unit_of(chirality) * Z.bottomRows(m));
}

ComplexMatrix from_chiral_coordinates(const ComplexMatrix& q, int chirality) {
  ComplexMatrix Z(2 * q.rows(), q.cols());
  Z.topRows(q.rows()) = inverse_root * q;
  Z.bottomRows(q.rows()) = (-inverse_root * unit_of(chirality)) * q;
  return Z;
}

ComplexMatrix chiral_block(const Matrix& canonical, int chirality) {
  return block_in(canonical, chirality);
}

ComplexMatrix chiral_block(const ComplexMatrix& canonical, int chirality) {
  return block_in(canonical, chirality);
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
