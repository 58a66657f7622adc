#include "continuation/step/ball_norm.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

namespace eigentrail {

void BallNorm::set_energy(std::shared_ptr<const EnergyNorm> energy, const ComplexMatrix& Z) {
  energy_ = std::move(energy);
  if (energy_) factor_ = Z.norm() / energy_->times(Z).norm();
}

void BallNorm::apply(ComplexVector& x) const {
  adapted_.apply(x);
  from_energy(x);
}

void BallNorm::apply_adjoint(ComplexVector& x) const {
  from_energy_adjoint(x);
  adapted_.apply(x);
}

void BallNorm::apply_inverse(ComplexVector& x) const {
  to_energy(x);
  adapted_.apply_inverse(x);
}

void BallNorm::apply_inverse_adjoint(ComplexVector& x) const {
  adapted_.apply_inverse(x);
  to_energy_adjoint(x);
}

double BallNorm::largest_eigenvalue_part() const {
  if (adapted_.is_plain()) return 1.0;
  // The rows of D that belong to Lambda; D is Hermitian, so that they are columns as well.
  const Eigen::Index size = n_ * k_ + k_ * k_;
  ComplexMatrix rows(size, k_ * k_);
  for (Eigen::Index i = 0; i < rows.cols(); ++i) {
    ComplexVector unit = ComplexVector::Unit(size, n_ * k_ + i);
    adapted_.apply(unit);
    rows.col(i) = unit;
  }
  const Eigen::SelfAdjointEigenSolver<ComplexMatrix> squares(ComplexMatrix(rows.adjoint() * rows),
                                                             Eigen::EigenvaluesOnly);
  return std::sqrt(squares.eigenvalues().maxCoeff());
}

}  // namespace eigentrail
