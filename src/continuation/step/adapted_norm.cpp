#include "continuation/step/adapted_norm.hpp"

#include <utility>

#include "continuation/step/balancing.hpp"

namespace eigentrail {
namespace {

/// Sweeps of the balancing of a small matrix; more change nothing.
constexpr int sweeps = 20;

}  // namespace

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
