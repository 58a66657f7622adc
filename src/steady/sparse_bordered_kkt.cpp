#include "steady/sparse_bordered_kkt.hpp"

#include <algorithm>
#include <limits>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

double largest(const Vector& entries) {
  return entries.size() > 0 ? entries.lpNorm<Eigen::Infinity>() : 0.0;
}

}  // namespace

double singularity_test(const SparseMatrix& K, const SparseMatrix& A, const KktKernel& nearby) {
  const KktBorder border{
      nearby.left, Matrix::Zero(A.rows(), 1), nearby.right.transpose(), {}, Matrix::Zero(1, 1)};
  Vector dx, dl, test;
  SparseBorderedKkt(K, A, border)
      .solve(Vector::Zero(K.rows()), Vector::Zero(A.rows()), Vector::Ones(1), dx, dl, test);
  return test[0];
}

SparseBorderedKkt::SparseBorderedKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border)
    : n_(K.rows()), m_(A.rows()) {
  const Eigen::Index q = border.unknown.rows();
  const double magnitude = positive_or_one(SystemMatrix(K).one_norm());
  const auto inverse = [magnitude](double size) { return magnitude / positive_or_one(size); };
  rows_ = Vector::Ones(n_ + m_ + q);
  columns_.resize(q);
  if (m_ > 0) rows_.segment(n_, m_) = row_scales(A, magnitude);
  const Vector reactions = rows_.segment(n_, m_);
  KktEntries entries = kkt_entries(K, A, reactions);
  Matrix corner = border.unknown;
  for (Eigen::Index k = 0; k < q; ++k) {
    Vector column(n_ + m_);
    column << border.force.col(k), reactions.cwiseProduct(border.constraint.col(k));
    columns_[k] = inverse(largest(column));
    corner.col(k) *= columns_[k];
    for (Eigen::Index i = 0; i < n_ + m_; ++i) entries.emplace_back(i, n_ + m_ + k, columns_[k] * column[i]);
  }
  for (Eigen::Index k = 0; k < q; ++k) {
    Vector row = Vector::Zero(n_ + m_ + q);
    row.head(n_) = border.x.row(k);
    if (border.lambda.size() > 0)
      row.segment(n_, m_) = reactions.cwiseProduct(border.lambda.row(k).transpose());
    row.tail(q) = corner.row(k);
    const Eigen::Index i = n_ + m_ + k;
    rows_[i] = inverse(largest(row));
    for (Eigen::Index j = 0; j < row.size(); ++j) entries.emplace_back(i, j, rows_[i] * row[j]);
  }
  matrix_.resize(rows_.size(), rows_.size());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  is_regular_ = matrix_.coeffs().allFinite() && lu_.factor(matrix_, SparseKind::near_symmetric);
}

void SparseBorderedKkt::solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl,
                              Vector& du) const {
  Vector right(rows_.size());
  right << r, g, h;
  right = rows_.cwiseProduct(right);
  Vector solution = Vector::Constant(right.size(), std::numeric_limits<double>::quiet_NaN());
  if (is_regular_) {
    solution = lu_.solve(Matrix(right));
    solution += Vector(lu_.solve(Matrix(right - matrix_ * solution)));  // restores what scaling cost
  }
  dx = solution.head(n_);
  dl = rows_.segment(n_, m_).cwiseProduct(solution.segment(n_, m_));
  du = columns_.cwiseProduct(solution.tail(h.size()));
}

}  // namespace eigentrail
