// Finds equilibria from poor guesses by relaxation on the constraint manifold.
//
// Pseudo-transient continuation (Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998) of the flow
//
//     x' = Q2 Q2^T (f - A^T lambda),   c(x) = 0
//
// by linearly implicit steps (delta I + K_t) w = Q2^T (f - A^T lambda), K_t = Q2^T K Q2 the tangent
// stiffness. delta is so large that delta I plus the symmetric part of K_t is positive definite; a step then
// never goes against the force. Minimum-norm corrections project the step back to the manifold. A step is
// shortened if the force along it would reverse. Mechanisms come to rest in stable equilibria; with
// circulatory forces there may be no state of rest.
#pragma once

#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

struct [[nodiscard]] RelaxationResult {
  bool at_rest = false;
  /// If no configuration meets the constraints: the constraint with the largest error in the closest
  /// configuration found, and the error. Empty otherwise.
  std::string unmet;
};

/// Relaxes x from any guess, until |Q2^T (f - A^T lambda)| <= tolerance times the largest |f| on the way. On
/// return `lambda` holds the least-squares multipliers at x.
RelaxationResult relax(const Model& model, const Vector& parameters, double tolerance, Vector& x,
                       Vector& lambda, EvaluationCounts& counts);

}  // namespace eigentrail
