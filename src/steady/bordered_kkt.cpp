#include "steady/bordered_kkt.hpp"

#include <cmath>

#include "core/products.hpp"

namespace eigentrail {
namespace {

/// Pivots below this share of the largest one belong to the kernel, in kernel_in_border.
constexpr double rounding_pivot = 1e-12;

/// Entries of conditions on multipliers below this share of the terms that they are sums of are rounding.
/// Scaling of their rows would otherwise make them look like equations.
constexpr double rounded_to_zero = 1e-14;

Matrix with_column(const Matrix& matrix, const Vector& column) {
  Matrix result(column.size(), matrix.cols() + 1);
  result << matrix, column;
  return result;
}

}  // namespace

KktBorder KktBorder::of(const TrimDerivatives& trim) {
  const bool of_multipliers = !trim.lambda.isZero(0.0);
  return {trim.force, trim.constraint, trim.x, of_multipliers ? trim.lambda : Matrix(), trim.trim};
}

KktBorder KktBorder::and_one(const Vector& of_force, const Vector& of_constraint, const Vector& along,
                             const Vector& of_others, double of_unknown) const {
  const Eigen::Index k = unknown.rows();
  const Eigen::Index m = of_constraint.size() - k;
  KktBorder result;
  result.force = with_column(force, of_force);
  result.constraint = with_column(constraint, of_constraint.head(m));
  result.x = with_column(x.transpose(), along).transpose();
  if (lambda.size() > 0) result.lambda = with_column(lambda.transpose(), Vector::Zero(m)).transpose();
  result.unknown = Matrix::Zero(k + 1, k + 1);
  result.unknown.topLeftCorner(k, k) = unknown;
  result.unknown.topRightCorner(k, 1) = of_constraint.tail(k);
  if (of_others.size() > 0) result.unknown.bottomLeftCorner(1, k) = of_others.transpose();
  result.unknown(k, k) = of_unknown;
  return result;
}

BorderedKkt::BorderedKkt(const SystemMatrix& K, const ConstraintFactorization& constraints, KktBorder border)
    : K_(K), constraints_(constraints), border_(std::move(border)) {
  const Matrix& Q2 = constraints_.null_basis();
  const Eigen::Index f = Q2.cols();
  const Eigen::Index q = border_.unknown.rows();
  follow_ = -constraints_.pseudo_inverse_times(border_.constraint);
  rows_of_x_ = border_.x.transpose();
  // L dl, with dl eliminated, adds to the rows of dx and du.
  Matrix row = rows_of_x_;
  Matrix of_unknown = border_.unknown;
  Vector reactions, terms;  // sizes of the rows of L (A^T)+, and of what is summed in rows of dx
  if (border_.lambda.size() > 0) {
    Matrix reaction(q, K_.rows());  // L (A^T)+
    for (Eigen::Index j = 0; j < K_.rows(); ++j)
      reaction.col(j) =
          border_.lambda * constraints_.transposed_pseudo_inverse_times(Vector::Unit(K_.rows(), j));
    row -= (reaction * K_).transpose();
    of_unknown -= reaction * border_.force;
    reactions = reaction.rowwise().norm();
    terms = rows_of_x_.colwise().norm().transpose() + reactions * K_.norm();
  }
  Matrix B(f + q, f + q);
  const MatrixSeries basis{Q2};
  const auto sparse = K_.is_sparse() ? SparseCongruence::of(basis, basis) : std::nullopt;
  B.topLeftCorner(f, f) = sparse ? (*sparse)({K_}, 1).front() : Matrix(Q2.transpose() * (K_ * Q2));
  for (Eigen::Index i = 0; i < q; ++i) {
    B.block(0, f + i, f, 1) = Q2.transpose() * (border_.force.col(i) + K_ * follow_.col(i));
    B.block(f + i, 0, 1, f) = row.col(i).transpose() * Q2;
    for (Eigen::Index j = 0; j < q; ++j) B(f + i, f + j) = of_unknown(i, j) + row.col(i).dot(follow_.col(j));
  }
  for (Eigen::Index i = 0; i < terms.size(); ++i) {
    const auto drop = [&](double& entry, double size) {
      if (std::abs(entry) <= rounded_to_zero * size) entry = 0.0;
    };
    for (Eigen::Index j = 0; j < f; ++j) drop(B(f + i, j), terms[i]);
    for (Eigen::Index j = 0; j < q; ++j)
      drop(B(f + i, f + j), std::abs(border_.unknown(i, j)) + reactions[i] * border_.force.col(j).norm() +
                                terms[i] * follow_.col(j).norm());
  }
  // Rows and columns of different units are scaled to unit norm.
  const auto inverse = [](double size) { return size > 0.0 ? 1.0 / size : 1.0; };
  rows_ = B.rowwise().norm().unaryExpr(inverse);
  B = rows_.asDiagonal() * B;
  columns_ = B.colwise().norm().transpose().unaryExpr(inverse);
  scaled_ = B * columns_.asDiagonal();
  lu_.compute(scaled_);
}

Vector BorderedKkt::multipliers(const Vector& r, const Vector& dx, const Vector& du) const {
  const Vector restored = K_ * dx;
  Vector force = r - restored;
  for (Eigen::Index i = 0; i < du.size(); ++i) force -= du[i] * border_.force.col(i);
  return constraints_.transposed_pseudo_inverse_times(force);
}

void BorderedKkt::solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl,
                        Vector& du) const {
  const Matrix& Q2 = constraints_.null_basis();
  const Eigen::Index f = Q2.cols();
  dx = constraints_.pseudo_inverse_times(g);
  Vector right(f + h.size());
  right.head(f) = Q2.transpose() * (r - K_ * dx);
  for (Eigen::Index i = 0; i < h.size(); ++i) right[f + i] = h[i] - rows_of_x_.col(i).dot(dx);
  if (border_.lambda.size() > 0)
    right.tail(h.size()) -= border_.lambda * multipliers(r, dx, Vector::Zero(h.size()));
  const Vector solution = columns_.cwiseProduct(lu_.solve(Vector(rows_.cwiseProduct(right))));
  du = solution.tail(h.size());
  Vector change = Q2 * solution.head(f);
  for (Eigen::Index i = 0; i < du.size(); ++i) change += du[i] * follow_.col(i);
  dx += change;
  dl = multipliers(r, dx, du);
}

int BorderedKkt::orientation() const {
  int sign = static_cast<int>(lu_.permutationP().determinant() * lu_.permutationQ().determinant());
  for (const double pivot : lu_.matrixLU().diagonal()) sign *= (pivot > 0.0) - (pivot < 0.0);
  return sign;
}

Matrix BorderedKkt::kernel_in_border() const {
  const Eigen::Index q = border_.unknown.rows();
  const auto in_border = [q](const Matrix& matrix) -> Vector {
    Eigen::FullPivLU<Matrix> lu(matrix);
    lu.setThreshold(rounding_pivot);
    if (lu.isInvertible()) return Vector::Zero(q);
    return lu.kernel().bottomRows(q).rowwise().norm();
  };
  Matrix result(2, q);
  result << in_border(scaled_).transpose(), in_border(scaled_.transpose()).transpose();
  return result;
}

}  // namespace eigentrail
