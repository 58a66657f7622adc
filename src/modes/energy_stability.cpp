#include "modes/energy_stability.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace eigentrail {
namespace {

/// Whether the symmetric part of A + shift D is positive definite, D the magnitude of the diagonal of A. It
/// is scaled to a diagonal of one, because entries of very different size have roundings of very different
/// size.
bool is_definite(const Matrix& A, double shift) {
  const Vector diagonal = A.diagonal().cwiseAbs();
  const Vector scale = diagonal.unaryExpr([](double a) { return a > 0.0 ? 1.0 / std::sqrt(a) : 1.0; });
  Matrix S = 0.5 * (A + A.transpose());
  S.diagonal() += shift * diagonal;
  return Eigen::LLT<Matrix>(Matrix(scale.asDiagonal() * S * scale.asDiagonal())).info() == Eigen::Success;
}

/// Rounding of an entry of a reduced matrix, and that of a Cholesky factor, relative to the diagonal.
double rounding_of_size(Eigen::Index n) {
  return 10.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
}

/// Rows and columns may be zero.
bool is_semidefinite(const Matrix& A) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (!A.row(i).isZero(0.0) || !A.col(i).isZero(0.0)) rows.push_back(i);
  }
  return rows.empty() || is_definite(A(rows, rows), rounding_of_size(A.rows()));
}

}  // namespace

bool is_stable_by_energy(const ReducedPencil& pencil, const Structure& structure) {
  if (structure.circulatory || !structure.symmetric_mass) return false;
  if (!pencil.parts.empty())
    return std::all_of(pencil.parts.begin(), pencil.parts.end(),
                       [&](const ReducedPencil& part) { return is_stable_by_energy(part, structure); });
  const Matrix& K = pencil.K[0];
  return is_definite(K, -rounding_of_size(K.rows())) && is_semidefinite(pencil.M[0]) &&
         (!structure.damped || is_semidefinite(pencil.C[0] + pencil.C[0].transpose()));
}

}  // namespace eigentrail
