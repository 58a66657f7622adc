#include "modes/energy_stability.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "core/positive_or_one.hpp"

namespace eigentrail {
namespace {

/// Whether the symmetric part of A + diag(shift) is positive definite. Units of the coordinates change
/// nothing: rounding of a Cholesky factor is relative to the diagonal.
bool is_definite(const Matrix& A, const Vector& shift) {
  Matrix S = 0.5 * (A + A.transpose());
  S.diagonal() += shift;
  return Eigen::LLT<Matrix>(S).info() == Eigen::Success;
}

/// Rounding of an entry of a reduced matrix, and that of a Cholesky factor, relative to the diagonal.
double rounding_of_size(Eigen::Index n) {
  return 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

/// Whether the symmetric part of A is positive semidefinite, but for rounding of the entries of A. Those of
/// its skew-symmetric part count: without damping of a coordinate nothing else is left of gyroscopic forces.
/// `units`: of the coordinates, in which entries of different rows are compared.
bool is_semidefinite(const Matrix& A, const Vector& units) {
  const Matrix balanced = units.asDiagonal() * A * units.asDiagonal();
  const Vector sizes = balanced.cwiseAbs().rowwise().sum() + balanced.cwiseAbs().colwise().sum().transpose();
  return is_definite(balanced, rounding_of_size(A.rows()) * sizes.unaryExpr(&positive_or_one));
}

}  // namespace

bool is_stable_by_energy(const ReducedPencil& pencil, const Structure& structure) {
  if (structure.circulatory || !structure.symmetric_mass) return false;
  if (!pencil.parts.empty())
    return std::all_of(pencil.parts.begin(), pencil.parts.end(),
                       [&](const ReducedPencil& part) { return is_stable_by_energy(part, structure); });
  const Matrix& K = pencil.K[0];
  if (!is_definite(K, -rounding_of_size(K.rows()) * K.diagonal().cwiseAbs())) return false;
  const Vector units = K.diagonal().cwiseSqrt().cwiseInverse();
  return is_semidefinite(pencil.M[0], units) && (!structure.damped || is_semidefinite(pencil.C[0], units));
}

}  // namespace eigentrail
