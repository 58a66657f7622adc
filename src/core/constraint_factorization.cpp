#include "eigentrail/core/constraint_factorization.hpp"

#include "core/sparse_constraints.hpp"

namespace eigentrail {

ConstraintFactorization::ConstraintFactorization(const SystemMatrix& A) {
  if (A.is_sparse() && A.rows() > 0) sparse_ = SparseConstraints::factor(A.sparse());
  if (!sparse_) {
    factor_dense(A.dense());
    return;
  }
  rank_ = A.rows();
  independence_ = sparse_->independence();
}

void ConstraintFactorization::factor_dense(const Matrix& A) {
  const Eigen::Index n = A.cols();
  if (A.rows() == 0) {
    null_basis_ = Matrix::Identity(n, n);
    return;
  }
  row_scale_ = A.rowwise().norm().unaryExpr([](double norm) { return norm > 0.0 ? 1.0 / norm : 1.0; });
  decomposition_.setThreshold(rank_tolerance);
  decomposition_.compute((row_scale_.asDiagonal() * A).transpose());
  rank_ = decomposition_.rank();
  const Vector pivots = decomposition_.matrixQTZ().diagonal().cwiseAbs();
  if (rank_ > 0) independence_ = pivots[rank_ - 1] / decomposition_.maxPivot();
  null_basis_.resize(n, n - rank_);
  if (rank_ < n) null_basis_ = decomposition_.householderQ() * Matrix::Identity(n, n).rightCols(n - rank_);
}

const Matrix& ConstraintFactorization::null_basis() const {
  return sparse_ ? sparse_->null_basis() : null_basis_;
}

Matrix ConstraintFactorization::dependences() const {
  const Eigen::Index m = row_scale_.size();
  if (rank_ == m) return Matrix::Zero(m, 0);
  // (D A)^T P = Q T Z: the last columns of P Z^T give zero
  Matrix result = Matrix::Identity(m, m).rightCols(m - rank_);
  result = decomposition_.matrixZ().transpose() * result;
  return row_scale_.asDiagonal() * (decomposition_.colsPermutation() * result);
}

Matrix ConstraintFactorization::allowed_part(const Matrix& X) const {
  return sparse_ ? sparse_->allowed_part(X) : Matrix(null_basis_ * (null_basis_.transpose() * X));
}

Matrix ConstraintFactorization::pseudo_inverse_times(const Matrix& B) const {
  if (sparse_) return sparse_->pseudo_inverse_times(B);
  if (B.rows() == 0) return Matrix::Zero(null_basis_.rows(), B.cols());
  return decomposition_.transpose().solve(row_scale_.asDiagonal() * B);
}

Vector ConstraintFactorization::transposed_pseudo_inverse_times(const Vector& b) const {
  if (sparse_) return sparse_->transposed_pseudo_inverse_times(b);
  if (row_scale_.size() == 0) return Vector(0);
  return row_scale_.asDiagonal() * decomposition_.solve(b);
}

}  // namespace eigentrail
