#include "steady/sparse_kkt.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

/// Iterations for the norm of the inverse tangent stiffness, of which only the magnitude is needed.
constexpr int power_iterations = 4;
/// Iterations for the kernel of a system that is singular up to rounding: each multiplies what else there is
/// by the ratio of the two smallest singular values.
constexpr int kernel_iterations = 3;

SparseMatrix kkt_matrix(const SparseMatrix& K, const SparseMatrix& A, const Vector& row_scale) {
  const KktEntries entries = kkt_entries(K, A, row_scale);
  const Eigen::Index size = K.rows() + A.rows();
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Vector random_vector(Eigen::Index size) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  return Vector::NullaryExpr(size, [&] { return normal(engine); });
}

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

Vector row_scales(const SparseMatrix& A, double magnitude) {
  return SystemMatrix(A).row_norms().unaryExpr(
      [magnitude](double norm) { return magnitude / positive_or_one(norm); });
}

std::shared_ptr<const SparseKkt> SparseKkt::factor(const SparseMatrix& K, const SparseMatrix& A) {
  std::shared_ptr<SparseKkt> result(new SparseKkt);
  const double magnitude = SystemMatrix(K).one_norm();
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return nullptr;
  result->n_ = K.rows();
  result->row_scale_ = row_scales(A, magnitude);
  result->matrix_ = kkt_matrix(K, A, result->row_scale_);
  if (!result->lu_.factor(result->matrix_, SparseKind::general)) return nullptr;
  const double condition = result->norm_of_tangent_inverse() * magnitude;
  if (!(condition < 1.0 / least_reciprocal_condition)) return nullptr;
  result->reciprocal_condition_ = 1.0 / std::max(1.0, condition);
  return result;
}

double SparseKkt::norm_of_tangent_inverse() {
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

std::optional<KktKernel> kkt_kernel(const SparseMatrix& K, const SparseMatrix& A) {
  const Eigen::Index n = K.rows();
  SparseFactors lu;
  if (!lu.factor(kkt_matrix(K, A, row_scales(A, SystemMatrix(K).one_norm())), SparseKind::general))
    return std::nullopt;
  Vector right = random_vector(n + A.rows());
  Vector left = right;
  for (int i = 0; i < kernel_iterations; ++i) {
    right = lu.solve(Matrix(left.normalized()));
    left = lu.solve_transposed(Matrix(right.normalized()));
  }
  return KktKernel{right.head(n).normalized(), left.head(n).normalized()};
}

LogDeterminant SparseKkt::determinant() const {
  LogDeterminant result = lu_.determinant();
  result.logarithm -= 2.0 * row_scale_.array().log().sum();
  return result;
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
