#include "continuation/step/balancing.hpp"

#include <cmath>

namespace eigentrail {

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

}  // namespace eigentrail
