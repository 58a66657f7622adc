// Equilibria from poor guesses: relaxation on the constraint manifold.
//
// Pseudo-transient continuation (Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998) of the gradient-like flow
//
//     x' = Q2 Q2^T (f - A^T lambda),   c(x) = 0
//
// in linearly implicit steps (delta I + S) w = Q2^T (f - A^T lambda), S the symmetric part of the tangent
// stiffness and delta at least so large that the matrix is positive definite: a step always goes downhill. It
// is drawn back to the manifold by minimum-norm corrections, and taken shorter where the force along it would
// turn. Mechanisms come to rest where they hang, that is, in stable equilibria; where forces circulate there
// may be no rest.
#pragma once

#include "eigentrail/steady/equilibrium.hpp"

namespace eigentrail {

struct RelaxationOptions {
  int max_steps = 2000;  ///< >= 1; each costs a factorization of A and of the tangent stiffness
  double tolerance =
      1e-8;  ///< at rest: |Q2^T (f - A^T lambda)| <= tolerance times the largest |f| on the way
  double longest_move = 0.2;  ///< of a step, in units of the largest coordinate, > 0
};

struct [[nodiscard]] RelaxationResult {
  bool at_rest = false;
  /// Where no configuration was found that meets the constraints: which one is missed most by the closest,
  /// and by how much. Empty otherwise.
  std::string unmet;
};

/// Relaxes x from any guess; `lambda` becomes the least-squares multipliers.
RelaxationResult relax(const Model& model, const Vector& parameters, const RelaxationOptions& options,
                       Vector& x, Vector& lambda, EvaluationCounts& counts);

}  // namespace eigentrail
