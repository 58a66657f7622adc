#include "continuation/step/ball_norm.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// Sweeps of the balancing of a small matrix; more change nothing.
constexpr int sweeps_of_norm = 20;

/// X with every column overwritten by a map.
ComplexMatrix by_columns(const BandCholesky& band, void (BandCholesky::*map)(Complex*) const,
                         ComplexMatrix X) {
  for (Eigen::Index j = 0; j < X.cols(); ++j) (band.*map)(X.col(j).data());
  return X;
}

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
  const Vector scales = balancing_scales(std::move(squares), sweeps_of_norm);
  AdaptedNorm norm;
  norm.Q_ = std::move(Q);
  norm.factors_ = scales.head(count) / scales[count];
  return norm;
}

std::shared_ptr<const EnergyNorm> EnergyNorm::of(const PencilAtPoint& pencil, double shift) {
  Matrix P = shift * shift * pencil.M + shift * pencil.C + pencil.K;
  BandCholesky band(0.5 * (P + P.transpose()));
  if (!band.exists()) return of_polar_factor(std::move(P));
  const bool is_narrow = is_narrow_band(band.width(), pencil.size());
  return std::shared_ptr<const EnergyNorm>(is_narrow ? new EnergyNorm(std::move(band))
                                                     : new EnergyNorm(band.full(), band.full_inverse()));
}

std::shared_ptr<const EnergyNorm> EnergyNorm::of_polar_factor(Matrix P) {
  const SingularVectors<Matrix> of_P = singular_vectors(std::move(P));
  const Vector& values = of_P.values;
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(values.size());
  // Not a number is not above it either.
  if (values.size() == 0 || !(values.minCoeff() > rounding * values.maxCoeff())) return nullptr;
  const Vector roots = values.cwiseSqrt();
  const auto with = [&](const Vector& diagonal) {
    return product(Matrix(of_P.V * diagonal.asDiagonal()), Matrix(of_P.V.transpose()));
  };
  return std::shared_ptr<const EnergyNorm>(new EnergyNorm(with(roots), with(roots.cwiseInverse())));
}

ComplexMatrix EnergyNorm::times(const ComplexMatrix& X) const {
  return band_ ? by_columns(*band_, &BandCholesky::apply, X) : product(root_, X);
}

ComplexMatrix EnergyNorm::transposed_times(const ComplexMatrix& X) const {
  return band_ ? by_columns(*band_, &BandCholesky::apply_transposed, X) : transposed_product(root_, X);
}

ComplexMatrix EnergyNorm::inverse_times(const ComplexMatrix& X) const {
  return band_ ? by_columns(*band_, &BandCholesky::solve, X) : product(inverse_root_, X);
}

ComplexMatrix EnergyNorm::inverse_transposed_times(const ComplexMatrix& X) const {
  return band_ ? by_columns(*band_, &BandCholesky::solve_transposed, X)
               : transposed_product(inverse_root_, X);
}

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
