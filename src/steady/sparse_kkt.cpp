#include "steady/sparse_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

/// Iterations for the norm of the inverse tangent stiffness, of which only the magnitude is needed.
constexpr int power_iterations = 4;

}  // namespace

KktEntries kkt_entries(const SparseMatrix& K, const SparseMatrix& A, const Vector& row_scale) {
  const Eigen::Index n = K.rows();
  KktEntries entries;
  entries.reserve(static_cast<std::size_t>(K.nonZeros() + 2 * A.nonZeros()));
  for (Eigen::Index j = 0; j < n; ++j) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry)
      entries.emplace_back(entry.row(), j, entry.value());
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const double value = row_scale[entry.row()] * entry.value();
      entries.emplace_back(n + entry.row(), j, value);
      entries.emplace_back(j, n + entry.row(), value);
    }
  }
  return entries;
}

std::shared_ptr<const SparseKkt> SparseKkt::factor(const SparseMatrix& K, const SparseMatrix& A) {
  std::shared_ptr<SparseKkt> result(new SparseKkt);
  const double magnitude = SystemMatrix(K).one_norm();
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return nullptr;
  result->n_ = K.rows();
  result->row_scale_ = SystemMatrix(A).row_norms().unaryExpr(
      [magnitude](double norm) { return magnitude / positive_or_one(norm); });
  const KktEntries entries = kkt_entries(K, A, result->row_scale_);
  const Eigen::Index size = K.rows() + A.rows();
  result->matrix_.resize(size, size);
  result->matrix_.setFromTriplets(entries.begin(), entries.end());
  if (!result->lu_.factor(result->matrix_, SparseKind::general)) return nullptr;
  const double condition = result->norm_of_tangent_inverse() * magnitude;
  if (!(condition < 1.0 / least_reciprocal_condition)) return nullptr;
  result->reciprocal_condition_ = 1.0 / std::max(1.0, condition);
  return result;
}

double SparseKkt::norm_of_tangent_inverse() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  Vector x = Vector::NullaryExpr(n_, [&] { return normal(engine); });
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

Vector SparseKkt::refined_solution(const Vector& right) const {
  Vector solution = lu_.solve(Matrix(right));
  solution += Vector(lu_.solve(Matrix(right - matrix_ * solution)));
  return solution;
}

void SparseKkt::solve(const Vector& r, const Vector& g, Vector& dx, Vector& dl) const {
  Vector right(matrix_.rows());
  right << r, row_scale_.cwiseProduct(g);
  const Vector solution = refined_solution(right);
  dx = solution.head(n_);
  dl = row_scale_.cwiseProduct(solution.tail(matrix_.rows() - n_));
}

}  // namespace eigentrail
