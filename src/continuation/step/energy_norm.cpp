#include "continuation/step/energy_norm.hpp"

#include <limits>
#include <utility>

#include "core/products.hpp"
#include "core/singular_vectors.hpp"

namespace eigentrail {
namespace {

/// H of P = Q H. Empty if P is singular or not finite.
Matrix polar_factor(Matrix P) {
  const SingularVectors<Matrix> of_P = singular_vectors(std::move(P));
  const Vector& values = of_P.values;
  const double rounding = std::numeric_limits<double>::epsilon() * static_cast<double>(values.size());
  // Not a number is not above it either.
  if (values.size() == 0 || !(values.minCoeff() > rounding * values.maxCoeff())) return {};
  return product(Matrix(of_P.V * values.asDiagonal()), Matrix(of_P.V.transpose()));
}

}  // namespace

EnergyNorm::EnergyNorm(BandCholesky root) : root_(std::move(root)) {}

std::shared_ptr<const EnergyNorm> EnergyNorm::of(const PencilAtPoint& pencil, double shift) {
  Matrix P = shift * shift * pencil.M + shift * pencil.C + pencil.K;
  BandCholesky root(0.5 * (P + P.transpose()));
  if (!root.exists()) root = BandCholesky(polar_factor(std::move(P)));
  return root.exists() ? std::shared_ptr<const EnergyNorm>(new EnergyNorm(std::move(root))) : nullptr;
}

}  // namespace eigentrail
