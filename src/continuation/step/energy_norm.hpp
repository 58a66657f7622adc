// A norm in which stiff and soft directions of a pencil count alike.
#pragma once

#include <memory>

#include "eigentrail/modes/pencil_at_point.hpp"

namespace eigentrail {

/// The norm |R x| with R = H^(1/2), where P = Q H is the polar decomposition of the pencil
/// P = w^2 M + w C + K at a real shift w > 0. If P is symmetric and positive definite, |R x|^2 = x^T P x is
/// the energy. A change dP of the pencil is measured by |R^-1 Q^T dP R^-1|, the change relative to P itself,
/// whatever the units of the coordinates and however far their stiffnesses are apart.
class EnergyNorm {
 public:
  /// By one singular value decomposition, in about 8 n^3 multiplications. Null if P is singular or not
  /// finite.
  static std::shared_ptr<const EnergyNorm> of(const PencilAtPoint& pencil, double shift);

  const Matrix& root() const { return root_; }                  ///< R, symmetric, n x n
  const Matrix& inverse_root() const { return inverse_root_; }  ///< R^-1

 private:
  EnergyNorm(Matrix root, Matrix inverse_root);

  Matrix root_, inverse_root_;
};

}  // namespace eigentrail
