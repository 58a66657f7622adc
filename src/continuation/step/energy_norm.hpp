// A norm in which stiff and soft directions of a pencil count alike.
#pragma once

#include <memory>
#include <optional>

#include "core/band_matrix.hpp"
#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

/// The norm |R x|, R^T R = H, by which a change dP of the pencil P = w^2 M + w C + K at a real shift w > 0 is
/// measured relative to P itself, whatever the units of the coordinates and however far their stiffnesses are
/// apart. H is the symmetric part of P where that is positive definite, so that |R x|^2 = x^T P x is the
/// energy; else the positive definite factor of the polar decomposition P = Q H.
class EnergyNorm {
 public:
  /// By a Cholesky factorization; if the symmetric part is not positive definite, by a singular value
  /// decomposition in about 8 n^3 multiplications. Null if P is singular or not finite.
  static std::shared_ptr<const EnergyNorm> of(const PencilAtPoint& pencil, double shift);

  /// R X, R^T X, R^-1 X and R^-T X for the columns of X, n rows.
  ComplexMatrix times(const ComplexMatrix& X) const;
  ComplexMatrix transposed_times(const ComplexMatrix& X) const;
  ComplexMatrix inverse_times(const ComplexMatrix& X) const;
  ComplexMatrix inverse_transposed_times(const ComplexMatrix& X) const;

 private:
  EnergyNorm(Matrix root, Matrix inverse_root);
  explicit EnergyNorm(BandCholesky band);
  /// Of the polar decomposition; null as above.
  static std::shared_ptr<const EnergyNorm> of_polar_factor(Matrix P);

  std::optional<BandCholesky> band_;  ///< R where it is banded
  Matrix root_, inverse_root_;        ///< R and R^-1 where it is not
};

}  // namespace eigentrail
