#include "continuation/step/ball_norm.hpp"

#include <utility>

#include "core/singular_vectors.hpp"

namespace eigentrail {

void BallNorm::set_energy(std::shared_ptr<const EnergyNorm> energy, const ComplexMatrix& Z) {
  energy_ = std::move(energy);
  if (energy_) factor_ = Z.norm() / energy_->times(Z).norm();
}

double BallNorm::largest_eigenvalue_part() const {
  if (adapted_.is_plain()) return 1.0;
  // The rows of D that belong to Lambda; D is Hermitian, so that they are columns as well.
  const Eigen::Index size = k_ * k_;
  ComplexMatrix rows = ComplexMatrix::Zero(n_ * k_ + size, size);
  rows.bottomRows(size).setIdentity();
  adapted_.apply(rows);
  return right_singular_vectors(std::move(rows)).values[0];
}

}  // namespace eigentrail
