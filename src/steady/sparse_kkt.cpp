#include "steady/sparse_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

/// Iterations for the norm of the inverse tangent stiffness, of which only the magnitude is needed.
constexpr int power_iterations = 4;
/// Iterations for the kernel of a system that is singular up to rounding: each multiplies what else there is
/// by the ratio of the two smallest singular values.
constexpr int kernel_iterations = 3;

double largest(const Vector& entries) {
  return entries.size() > 0 ? entries.lpNorm<Eigen::Infinity>() : 0.0;
}

Vector random_vector(Eigen::Index size) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  return Vector::NullaryExpr(size, [&] { return normal(engine); });
}

}  // namespace

KktBorder KktKernel::border(Eigen::Index n_constraints) const {
  return {left, Matrix::Zero(n_constraints, 1), right.transpose(), {}, Matrix::Zero(1, 1)};
}

std::shared_ptr<const SparseKkt> SparseKkt::factor(const SparseMatrix& K, const SparseMatrix& A) {
  const double magnitude = SystemMatrix(K).one_norm();
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return nullptr;
  std::shared_ptr<SparseKkt> result(new SparseKkt(K, A, {}, SparseKind::general));
  if (!result->is_regular_) return nullptr;
  const double condition = result->norm_of_tangent_inverse() * magnitude;
  if (!(condition < 1.0 / least_reciprocal_condition)) return nullptr;
  result->reciprocal_condition_ = 1.0 / std::max(1.0, condition);
  return result;
}

SparseKkt::SparseKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border)
    : SparseKkt(K, A, border, SparseKind::near_symmetric) {}

SparseKkt::SparseKkt(const SparseMatrix& K, const SparseMatrix& A, const KktBorder& border, SparseKind kind)
    : n_(K.rows()), m_(A.rows()) {
  const Eigen::Index q = border.unknown.rows();
  const double magnitude = positive_or_one(SystemMatrix(K).one_norm());
  const auto inverse = [magnitude](double size) { return magnitude / positive_or_one(size); };
  rows_ = Vector::Ones(n_ + m_ + q);
  columns_.resize(q);
  if (m_ > 0) rows_.segment(n_, m_) = SystemMatrix(A).row_norms().unaryExpr(inverse);
  const Vector reactions = rows_.segment(n_, m_);
  std::vector<Eigen::Triplet<double>> entries = kkt_entries(K, A, reactions);
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
  is_regular_ = matrix_.coeffs().allFinite() && lu_.factor(matrix_, kind);
}

double SparseKkt::norm_of_tangent_inverse() const {
  Vector x = random_vector(n_);
  double norm = 0.0;
  Vector right = Vector::Zero(matrix_.rows());
  for (int i = 0; i < power_iterations; ++i) {
    right.head(n_) = x.normalized();
    x = Vector(lu_.solve(Matrix(right))).head(n_);
    norm = x.norm();
    if (!std::isfinite(norm) || norm == 0.0) break;
    right.head(n_) = x / norm;
    x = Vector(lu_.solve_transposed(Matrix(right))).head(n_);
  }
  return norm;
}

LogDeterminant SparseKkt::determinant() const {
  LogDeterminant result = lu_.determinant();
  result.logarithm -= 2.0 * rows_.segment(n_, m_).array().log().sum();
  return result;
}

void SparseKkt::solve(const Vector& r, const Vector& g, const Vector& h, Vector& dx, Vector& dl,
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

std::optional<KktKernel> kkt_kernel(const SparseMatrix& K, const SparseMatrix& A) {
  const Eigen::Index n = K.rows();
  const SparseKkt kkt(K, A, {}, SparseKind::general);
  if (!kkt.is_regular_) return std::nullopt;
  Vector right = random_vector(n + A.rows());
  Vector left = right;
  for (int i = 0; i < kernel_iterations; ++i) {
    right = kkt.lu_.solve(Matrix(left.normalized()));
    left = kkt.lu_.solve_transposed(Matrix(right.normalized()));
  }
  return KktKernel{right.head(n).normalized(), left.head(n).normalized()};
}

double singularity_test(const SparseMatrix& K, const SparseMatrix& A, const KktKernel& nearby) {
  Vector dx, dl, test;
  SparseKkt(K, A, nearby.border(A.rows()))
      .solve(Vector::Zero(K.rows()), Vector::Zero(A.rows()), Vector::Ones(1), dx, dl, test);
  return test[0];
}

}  // namespace eigentrail
