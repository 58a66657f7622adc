#include "continuation/step/adapted_norm.hpp"

#include <cmath>
#include <utility>

namespace eigentrail {
namespace {

/// Sweeps of the balancing of a small matrix; more change nothing.
constexpr int sweeps = 20;

}  // namespace

Vector balancing_scales(Matrix squares, int sweeps) {
  squares.diagonal().setZero();
  Vector scales = Vector::Ones(squares.rows());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (Eigen::Index i = 0; i < scales.size(); ++i) {
      const double ratio = std::sqrt(squares.row(i).sum() / squares.col(i).sum());
      if (!(ratio > 0.0) || !std::isfinite(ratio)) continue;
      squares.col(i) *= ratio;
      squares.row(i) /= ratio;
      scales[i] *= std::sqrt(ratio);
    }
  }
  return scales;
}

AdaptedNorm AdaptedNorm::balancing(ComplexMatrix Q, const ComplexMatrix& TQ, const ComplexMatrix& adjoint) {
  const Eigen::Index count = Q.cols();
  const ComplexMatrix within = Q.adjoint() * TQ;
  Matrix squares = Matrix::Zero(count + 1, count + 1);
  squares.topLeftCorner(count, count) = within.cwiseAbs2();
  squares.col(count).head(count) = (adjoint - Q * within.adjoint()).colwise().squaredNorm();
  squares.row(count).head(count) = (TQ - Q * within).colwise().squaredNorm();
  const Vector scales = balancing_scales(std::move(squares), sweeps);
  AdaptedNorm norm;
  norm.Q_ = std::move(Q);
  norm.factors_ = scales.head(count) / scales[count];
  return norm;
}

}  // namespace eigentrail
