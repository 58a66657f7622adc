#include "continuation/step/energy_norm.hpp"

#include <limits>
#include <utility>

#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// X with every column overwritten by a map.
ComplexMatrix by_columns(const BandCholesky& band, void (BandCholesky::*map)(Complex*) const,
                         ComplexMatrix X) {
  for (Eigen::Index j = 0; j < X.cols(); ++j) (band.*map)(X.col(j).data());
  return X;
}

}  // namespace

EnergyNorm::EnergyNorm(Matrix root, Matrix inverse_root)
    : root_(std::move(root)), inverse_root_(std::move(inverse_root)) {}

EnergyNorm::EnergyNorm(BandCholesky band) : band_(std::move(band)) {}

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

}  // namespace eigentrail
