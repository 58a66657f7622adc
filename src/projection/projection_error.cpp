#include "projection/projection_error.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/products.hpp"
#include "eigentrail/core/complex_lu.hpp"

namespace eigentrail {

ProjectedMode mode_of(const SmallPencil& small, Complex s) {
  constexpr int solutions = 3;
  // A shift beside the eigenvalue keeps the solution finite; its distance is far below that to others.
  const Complex beside = s + 1e-10 * std::max(std::abs(s), 1e-300);
  const ComplexLu lu(ComplexMatrix(beside * beside * small.M + beside * small.C + small.K));
  const ComplexVector start = ComplexVector::LinSpaced(lu.size(), Complex(1.0, 0.5), Complex(2.0, -0.3));
  ProjectedMode mode{s, start, start};
  for (int i = 0; i < solutions; ++i) {
    lu.solve_in_place(mode.right);
    mode.right.normalize();
    lu.solve_adjoint_in_place(mode.left);  // its solutions are the conjugates of left vectors
    mode.left.normalize();
  }
  mode.left = mode.left.conjugate().eval();
  return mode;
}

RefinedMode refined_mode(const SmallPencil& small, Complex s, const ComplexVector& shape) {
  constexpr double elsewhere = 0.05;  // of |s|: far above the tolerance of the trace
  constexpr int rounds = 3;           // each doubles the digits
  constexpr double settled = 1e-8;    // of |s|: what is left is the square of the last correction
  if (!std::isfinite(std::abs(s)) || s == 0.0) return {{s, {}, {}}, true};
  const auto& [M, C, K] = small;
  RefinedMode refined{{s, {}, {}}};
  ProjectedMode& mode = refined.mode;
  for (int i = 0; i < rounds && !refined.is_settled; ++i) {
    mode = mode_of(small, mode.s);
    const ComplexVector inertia = M * mode.right, damping = C * mode.right;
    const Complex residual = mode.left.transpose() * (mode.s * (mode.s * inertia + damping) + K * mode.right);
    const Complex slope = mode.left.transpose() * (2.0 * mode.s * inertia + damping);
    const Complex correction = residual / slope;
    mode.s -= correction;
    if (!(std::abs(mode.s - s) < elsewhere * std::abs(s))) return {{s, shape, mode_of(small, s).left}};
    refined.is_settled = std::abs(correction) <= settled * std::abs(s);
  }
  return refined;
}

namespace {

/// Real parts of vectors of the modes in the first half of the columns, imaginary parts in the second one.
Matrix parts_of(const std::vector<ProjectedMode>& modes, ComplexVector ProjectedMode::*vector) {
  const auto k = static_cast<Eigen::Index>(modes.size());
  Matrix parts((modes.front().*vector).size(), 2 * k);
  for (Eigen::Index j = 0; j < k; ++j) {
    parts.col(j) = (modes[static_cast<std::size_t>(j)].*vector).real();
    parts.col(k + j) = (modes[static_cast<std::size_t>(j)].*vector).imag();
  }
  return parts;
}

/// Vector j of such parts.
template <class Parts>
ComplexVector vector_of(const Parts& parts, Eigen::Index j) {
  ComplexVector vector(parts.rows());
  vector.real() = parts.col(j);
  vector.imag() = parts.col(parts.cols() / 2 + j);
  return vector;
}

}  // namespace

std::vector<ProjectedMode> lifted(const std::vector<ProjectedMode>& modes, const Matrix& right_basis,
                                  const Matrix& left_basis) {
  if (modes.empty()) return {};
  const Matrix right = parts_of(modes, &ProjectedMode::right), left = parts_of(modes, &ProjectedMode::left);
  const Eigen::Index n = right_basis.rows(), k = right.cols();
  Matrix all(n, 2 * k);
  if (&right_basis == &left_basis) {  // a large one is read once
    Matrix both(right.rows(), 2 * k);
    both << right, left;
    all = product(right_basis, both);
  } else {
    all << product(right_basis, right), product(left_basis, left);
  }
  std::vector<ProjectedMode> result;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    result.push_back({modes[i].s, vector_of(all.leftCols(k), j).normalized(),
                      vector_of(all.rightCols(k), j).normalized()});
  }
  return result;
}

double EigenvalueError::relative_to(double size) const {
  return distance / size * std::min(1.0, (distance + 2.0 * half_gap) / size);
}

namespace {

/// Length of a force in the dual of the norm v^T D v of the motions v that the constraints allow: with
/// constraints, the least length of r + A^T mu, by normal equations.
class DualNorm {
 public:
  DualNorm(const SparseMatrix& A, const Vector& D) : weights_(D.cwiseSqrt().cwiseInverse()) {
    if (A.rows() == 0) return;
    const SparseMatrix weighted = A * weights_.asDiagonal();
    S_ = SystemMatrix(weighted).row_norms().cwiseInverse().asDiagonal() * weighted;
    normal_.compute(S_ * SparseMatrix(S_.transpose()));
  }

  /// `r`: real and imaginary part of the force, n x 2.
  double operator()(Matrix r) const {
    r = weights_.asDiagonal() * r;
    for (int pass = 0; pass < 2 && S_.rows() > 0; ++pass) r -= S_.transpose() * normal_.solve(Matrix(S_ * r));
    return r.norm();
  }

 private:
  Vector weights_;
  SparseMatrix S_;  ///< 0 x 0 without constraints
  Eigen::SimplicialLDLT<SparseMatrix> normal_;
};

/// M, C and K times vectors, whose real parts are the first half of the columns, n x 2k.
struct TermProducts {
  RowBlock M, C, K;

  /// (M s^2 + C s + K) times each vector, with its own s.
  RowBlock residuals(const ComplexVector& s) const {
    const Vector a = s.real(), b = s.imag(), p = s.cwiseAbs2().real() - 2.0 * b.cwiseAbs2(),
                 q = 2.0 * a.cwiseProduct(b);  // s^2 = p + i q
    const Eigen::Index k = M.cols() / 2;
    RowBlock R(M.rows(), 2 * k);
    R.leftCols(k) = M.leftCols(k) * p.asDiagonal();
    R.leftCols(k) -= M.rightCols(k) * q.asDiagonal();
    R.leftCols(k) += C.leftCols(k) * a.asDiagonal();
    R.leftCols(k) -= C.rightCols(k) * b.asDiagonal();
    R.rightCols(k) = M.leftCols(k) * q.asDiagonal();
    R.rightCols(k) += M.rightCols(k) * p.asDiagonal();
    R.rightCols(k) += C.leftCols(k) * b.asDiagonal();
    R.rightCols(k) += C.rightCols(k) * a.asDiagonal();
    return R + K;
  }
};

/// Real and imaginary part of the force j of a block, n x 2.
Matrix force(const RowBlock& block, Eigen::Index j) {
  Matrix parts(block.rows(), 2);
  parts << block.col(j), block.col(block.cols() / 2 + j);
  return parts;
}

}  // namespace

std::vector<EigenvalueError> eigenvalue_errors(const SparsePencil& pencil,
                                               const std::vector<ProjectedMode>& modes) {
  if (modes.empty()) return {};
  const Vector M = pencil.M.diagonal().cwiseAbs(), C = pencil.C.diagonal().cwiseAbs(),
               K = pencil.K.diagonal().cwiseAbs();
  const RowBlock right = parts_of(modes, &ProjectedMode::right);
  const TermProducts products{pencil.M * right, pencil.C * right, pencil.K * right};
  TermProducts transposed;
  if (!pencil.symmetric) {
    const RowBlock left = parts_of(modes, &ProjectedMode::left);
    transposed = {pencil.M.transpose() * left, pencil.C.transpose() * left, pencil.K.transpose() * left};
  }
  ComplexVector s_of(static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) s_of[static_cast<Eigen::Index>(i)] = modes[i].s;
  const RowBlock residuals = products.residuals(s_of);
  const RowBlock of_left = pencil.symmetric ? RowBlock() : transposed.residuals(s_of);
  std::vector<EigenvalueError> errors;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto j = static_cast<Eigen::Index>(i);
    const Complex s = modes[i].s;
    const ComplexVector& y = pencil.symmetric ? modes[i].right : modes[i].left;
    const Vector scale = std::norm(s) * M + std::abs(s) * C + K;
    const DualNorm size(pencil.A, (scale.array() + 1e-12 * scale.maxCoeff()).matrix());
    const double right_size = size(force(residuals, j));
    const double residual = right_size * (pencil.symmetric ? right_size : size(force(of_left, j)));
    const ComplexVector inertia = 2.0 * vector_of(products.M, j);
    const double slope = std::abs(y.cwiseProduct(s * inertia + vector_of(products.C, j)).sum());
    const double curvature = std::abs(y.cwiseProduct(inertia).sum());
    errors.push_back({2.0 * residual / (slope + std::sqrt(slope * slope + 2.0 * curvature * residual)),
                      slope / curvature});
  }
  return errors;
}

double half_gap(const SmallPencil& small, const ProjectedMode& mode) {
  const ComplexVector inertia = 2.0 * (small.M * mode.right);
  const Complex slope = mode.left.cwiseProduct(mode.s * inertia + small.C * mode.right).sum();
  return std::abs(slope) / std::abs(mode.left.cwiseProduct(inertia).sum());
}

}  // namespace eigentrail
