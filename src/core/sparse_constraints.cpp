#include "core/sparse_constraints.hpp"

#include <Eigen/QR>
#include <cmath>

#include "core/diagonal_blocks.hpp"
#include "eigentrail/core/constraint_factorization.hpp"

namespace eigentrail {

std::shared_ptr<const SparseConstraints> SparseConstraints::factor(const SparseMatrix& A) {
  std::shared_ptr<SparseConstraints> result(new SparseConstraints);
  const Vector norms = SystemMatrix(A).row_norms();
  if (A.rows() > A.cols() || !(norms.minCoeff() > 0.0) || !norms.allFinite()) return nullptr;
  result->row_scale_ = norms.cwiseInverse();
  result->S_ = result->row_scale_.asDiagonal() * A;
  result->S_transposed_ = result->S_.transpose();
  result->normal_.compute(result->S_ * result->S_transposed_);
  if (result->normal_.info() != Eigen::Success) return nullptr;
  const Vector pivots = result->normal_.vectorD();
  result->independence_ = std::sqrt(std::max(0.0, pivots.minCoeff() / pivots.maxCoeff()));
  if (!(result->independence_ > least_independence)) return nullptr;
  return result;
}

const Matrix& SparseConstraints::null_basis() const {
  std::call_once(asked_, [&] {
    const Matrix S(S_);
    null_basis_ = Matrix::Zero(S.cols(), S.cols() - S.rows());
    Eigen::Index first = 0;
    for (const DiagonalBlock& block : diagonal_blocks(S_)) {
      const Matrix rows = S(block.rows, block.columns);
      const Matrix basis = ConstraintFactorization(rows).null_basis();
      null_basis_.middleCols(first, basis.cols())(block.columns, Eigen::all) = basis;
      first += basis.cols();
    }
  });
  return null_basis_;
}

Matrix SparseConstraints::scaled_pseudo_inverse_times(const Matrix& B) const {
  Matrix X = S_transposed_ * normal_.solve(B);
  X += S_transposed_ * normal_.solve(B - S_ * X);
  return X;
}

Matrix SparseConstraints::pseudo_inverse_times(const Matrix& B) const {
  return scaled_pseudo_inverse_times(row_scale_.asDiagonal() * B);
}

Matrix SparseConstraints::allowed_part(const Matrix& X) const {
  // One repetition is enough: the first projection leaves a part in the row space of the size of the rounding
  // error of X, the second one the rounding error of that part.
  Matrix Y = X - S_transposed_ * normal_.solve(S_ * X);
  Y -= S_transposed_ * normal_.solve(S_ * Y);
  return Y;
}

Vector SparseConstraints::transposed_pseudo_inverse_times(const Vector& b) const {
  Vector scaled = normal_.solve(S_ * b);
  scaled += normal_.solve(S_ * (b - S_transposed_ * scaled));
  return row_scale_.cwiseProduct(scaled);
}

}  // namespace eigentrail
