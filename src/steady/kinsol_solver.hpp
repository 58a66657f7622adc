// KINSOL behind a small interface: damped Newton for F(u) = 0 with a linear solver of our own.
#pragma once

#include <functional>
#include <string>

#include "eigentrail/core/types.hpp"

namespace eigentrail {

struct KinsolProblem {
  /// F(u); returns false where F is not defined (the line search then shortens the step).
  std::function<bool(const Vector& u, Vector& f)> residual;
  /// Factors the Jacobian at u; returns false where that is impossible.
  std::function<bool(const Vector& u)> factor;
  /// Solves J du = b with the last factorization.
  std::function<void(const Vector& b, Vector& du)> solve;
  Vector u_scale;  ///< typical 1/|u_i|
  Vector f_scale;  ///< typical 1/|F_i|
};

struct KinsolResult {
  bool converged = false;
  int iterations = 0;
  std::string message;  ///< KINSOL's reason when it did not converge
};

/// Solves from u in place. An exception thrown by a callback is passed on after KINSOL has returned.
KinsolResult solve_with_kinsol(const KinsolProblem& problem, double tolerance, int max_iterations, Vector& u);

}  // namespace eigentrail
