#include "continuation/step/energy_norm.hpp"

#include <limits>
#include <utility>

#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {

EnergyNorm::EnergyNorm(Matrix root, Matrix inverse_root)
    : root_(std::move(root)), inverse_root_(std::move(inverse_root)) {}

std::shared_ptr<const EnergyNorm> EnergyNorm::of(const PencilAtPoint& pencil, double shift) {
  const SingularVectors<Matrix> of_P =
      singular_vectors(Matrix(shift * shift * pencil.M + shift * pencil.C + pencil.K));
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

}  // namespace eigentrail
