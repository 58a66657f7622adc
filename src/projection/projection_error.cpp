#include "projection/projection_error.hpp"

#include <Eigen/LU>
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

double error_indicator(const SparsePencil& pencil, const ProjectedMode& mode) {
  const double s = std::abs(mode.s);
  const Vector scale = s * s * pencil.M.diagonal().cwiseAbs() + s * pencil.C.diagonal().cwiseAbs() +
                       pencil.K.diagonal().cwiseAbs();
  const double floor = 1e-12 * scale.maxCoeff();
  const auto size = [&](const ComplexMatrix& residual) {
    return std::sqrt((residual.col(0).cwiseAbs2().array() / (scale.array() + floor)).sum());
  };
  const ComplexVector slope = 2.0 * mode.s * (pencil.M * mode.right) + pencil.C * mode.right;
  const Complex product = mode.left.transpose() * slope;
  return size(pencil.times(mode.s, mode.right)) * size(pencil.transposed_times(mode.s, mode.left)) /
         std::abs(product);
}

}  // namespace eigentrail
