#include "eigentrail/reduction/chirality.hpp"

#include <cmath>
#include <numbers>

namespace eigentrail {
namespace {

Complex turn(int chirality) {
  return {0.0, static_cast<double>(chirality)};
}

constexpr double unit = 0.5 * std::numbers::sqrt2;

template <class Values>
ComplexMatrix block_of(const Values& canonical, int chirality) {
  const Eigen::Index m = canonical.rows() / 2;
  return canonical.topLeftCorner(m, m) +
         turn(chirality) * canonical.bottomLeftCorner(m, m).template cast<Complex>();
}

}  // namespace

ComplexMatrix chiral_coordinates(const ComplexMatrix& Z, int chirality) {
  const Eigen::Index m = Z.rows() / 2;
  return unit * (Z.topRows(m) + turn(chirality) * Z.bottomRows(m));
}

ComplexMatrix from_chiral_coordinates(const ComplexMatrix& q, int chirality) {
  ComplexMatrix Z(2 * q.rows(), q.cols());
  Z.topRows(q.rows()) = unit * q;
  Z.bottomRows(q.rows()) = (-unit * turn(chirality)) * q;
  return Z;
}

ComplexMatrix chiral_block(const Matrix& canonical, int chirality) {
  return block_of(canonical, chirality);
}

ComplexMatrix chiral_block(const ComplexMatrix& canonical, int chirality) {
  return block_of(canonical, chirality);
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
