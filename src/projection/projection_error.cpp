#include "projection/projection_error.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace eigentrail {

ComplexVector left_vector(const Matrix& M, const Matrix& C, const Matrix& K, Complex s) {
  // A shift beside the eigenvalue keeps the solution finite; its distance is far below that to others.
  const Complex beside = s + 1e-10 * std::max(std::abs(s), 1e-300);
  const ComplexMatrix P =
      (beside * beside * M.cast<Complex>() + beside * C.cast<Complex>() + K.cast<Complex>());
  const Eigen::PartialPivLU<ComplexMatrix> lu(P.transpose());
  ComplexVector y = ComplexVector::LinSpaced(P.rows(), Complex(1.0, 0.5), Complex(2.0, -0.3));
  for (int i = 0; i < 3; ++i) y = lu.solve(y).normalized();
  return y;
}

void refine(const Matrix& M, const Matrix& C, const Matrix& K, ModeState& mode) {
  constexpr double elsewhere = 0.05;  // of |s|: far above the tolerance of the trace
  constexpr int rounds = 3;           // each doubles the digits
  if (!std::isfinite(std::abs(mode.s)) || mode.s == 0.0) return;
  Complex s = mode.s;
  ComplexVector right;
  for (int i = 0; i < rounds; ++i) {
    right = left_vector(M.transpose(), C.transpose(), K.transpose(), s);
    const ComplexVector left = left_vector(M, C, K, s);
    const Complex residual = left.transpose() * (s * s * (M * right) + s * (C * right) + K * right);
    const Complex slope = left.transpose() * (2.0 * s * (M * right) + C * right);
    s -= residual / slope;
    if (!(std::abs(s - mode.s) < elsewhere * std::abs(mode.s))) return;
  }
  mode.s = s;
  mode.shape = right;
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

  double operator()(const ComplexVector& r) const {
    Matrix parts(r.size(), 2);
    parts << r.real(), r.imag();
    parts = weights_.asDiagonal() * parts;
    for (int pass = 0; pass < 2 && S_.rows() > 0; ++pass)
      parts -= S_.transpose() * normal_.solve(Matrix(S_ * parts));
    return parts.norm();
  }

 private:
  Vector weights_;
  SparseMatrix S_;  ///< 0 x 0 without constraints
  Eigen::SimplicialLDLT<SparseMatrix> normal_;
};

}  // namespace

EigenvalueError eigenvalue_error(const SparsePencil& pencil, const ProjectedMode& mode) {
  const double s = std::abs(mode.s);
  const Vector scale = s * s * pencil.M.diagonal().cwiseAbs() + s * pencil.C.diagonal().cwiseAbs() +
                       pencil.K.diagonal().cwiseAbs();
  const DualNorm size(pencil.A, (scale.array() + 1e-12 * scale.maxCoeff()).matrix());
  const double residual =
      size(pencil.times(mode.s, mode.right).col(0)) * size(pencil.transposed_times(mode.s, mode.left).col(0));
  const ComplexVector inertia = 2.0 * (pencil.M * mode.right);
  const double slope = std::abs(mode.left.cwiseProduct(mode.s * inertia + pencil.C * mode.right).sum());
  const double curvature = std::abs(mode.left.cwiseProduct(inertia).sum());
  return {2.0 * residual / (slope + std::sqrt(slope * slope + 2.0 * curvature * residual)),
          slope / curvature};
}

double half_gap(const Matrix& M, const Matrix& C, const Matrix& K, const ModeState& mode) {
  const ComplexVector left = left_vector(M, C, K, mode.s);
  const ComplexVector inertia = 2.0 * (M * mode.shape);
  const Complex slope = left.cwiseProduct(mode.s * inertia + C * mode.shape).sum();
  return std::abs(slope) / std::abs(left.cwiseProduct(inertia).sum());
}

}  // namespace eigentrail
